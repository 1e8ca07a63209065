#include "tools/stability/ray_jury.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/estimate/estimator.h"
#include "tools/stability/oracles/ray_oracle.h"
#include "tools/stability/oracles/shape_of.h"

namespace strata::tools::stability {

namespace {

// Probes of the walk along one ray, so that a run ends in time; a ray that is cut short counts as judged so far.
constexpr long kMostProbes = 60000;

}  // namespace

RayJury::RayJury(const SceneSpec& spec, const Settings& settings, std::uint32_t step_limit)
    : spec_(spec), scene_(spec.scene()), settings_(settings), image_(scene_, integrate::Tracer::fast, step_limit) {}

double RayJury::time() const { return estimate::estimator_settings(scene_).shutter.middle_s(); }

trace::Ray RayJury::local(const WorldRay& ray) const {
    const double t = time();
    if (ray.pixel) return image_.local_camera_ray(ray.pixel->x + 0.5, ray.pixel->y + 0.5, t);
    return image_.to_local(image_.placement().orientation(t), image_.world_ray(ray.origin, ray.direction, t), t);
}

std::vector<trace::Hit> RayJury::trace(std::span<const trace::Ray> rays) const {
    std::vector<trace::Hit> hits(rays.size());
    trace::TraceCounters counters;
    image_.trace(rays, hits, counters);
    return hits;
}

std::string RayJury::replay(const WorldRay& ray) const {
    if (ray.pixel) return spec_.command("probe ray", fmt::format("--pixel {},{}", ray.pixel->x, ray.pixel->y));
    return fmt::format("echo {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} | ", ray.origin.x, ray.origin.y,
                       ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z) +
           spec_.command("probe ray");
}

// What double arithmetic leaves open of f at a point up to `size` from the origin, for tracer and oracle alike, with
// u = 2^-53: positions are rounded by 3 u of their size along the ray and 2 u on the way to lattice cells, each worth
// L; |x| - R by 4 u of |x|; K octaves by 40 u of their amplitude each (a few ulp of eight corners) and K + 1 of the
// sum. Twice that, since both sides err: less than 2^-49 times the sizes.
double RayJury::rounding(double size) const {
    const trace::Field& f = image_.field();
    const double radius = std::abs(f.base(glm::dvec3(0.0)));
    const double octaves = static_cast<double>(f.octaves().size());
    return 0x1p-49 * (f.lipschitz() * size + radius + (octaves / 8.0 + 6.0) * f.amplitude());
}

void RayJury::judge(std::span<const WorldRay> rays) {
    std::vector<trace::Ray> local_rays;
    local_rays.reserve(rays.size());
    for (const WorldRay& ray : rays) local_rays.push_back(local(ray));
    const std::vector<trace::Hit> hits = trace(local_rays);
    for (std::size_t i = 0; i < rays.size() && !settings_.cancelled(); ++i) {
        judge_claim(local_rays[i], hits[i], 0.0, [&] { return replay(rays[i]); });
    }
}

void RayJury::judge_claim(const trace::Ray& ray, const trace::Hit& hit, double displaced,
                          const std::function<std::string()>& describe) {
    ++rays_;
    steps_ += hit.steps;
    most_steps_.see(hit.steps, describe);
    if (hit.state == trace::HitState::unresolved) {
        ++unresolved_;
        violation_ = "unresolved: " + describe();
        return;
    }
    const bool is_hit = hit.state == trace::HitState::hit;
    hits_ += is_hit;
    const auto delta = [&](double s) { return ray.delta0 + ray.delta_slope * s; };
    const oracle::Vec origin = oracle::as_vec(ray.origin), direction = oracle::as_vec(ray.direction);
    const trace::Interval inside = image_.field().clip(ray.origin, ray.direction, ray.limit);
    const double farthest = is_hit ? hit.s : std::min(ray.limit, std::max(inside.end, 0.0));
    const double open =
        rounding(glm::length(ray.origin) + farthest + glm::length(ray.noise_shift)) + field().lipschitz() * displaced;

    // (i) counts stretches with f below the rounding, (ii) asks for a point with f no higher than it.
    oracle::Shape shape = oracle::shape_of(scene_.surface, time());
    shape.lift = open;
    const oracle::Verdict passed =
        judge_ray(oracle::FieldOracle(shape), origin, direction, ray.limit, delta, {is_hit, hit.s}, kMostProbes);
    thickest_ = std::max(thickest_, passed.thickest);
    cut_short_ += passed.cut_short;
    bool unfounded = false;
    if (is_hit) {
        shape.lift = -open;
        const oracle::FieldOracle lowered(shape);
        const auto f = [&](double s) {
            return lowered.probe(
                {origin[0] + s * direction[0], origin[1] + s * direction[1], origin[2] + s * direction[2]}, direction);
        };
        oracle::Span span = oracle::clip(shape, origin, direction, ray.limit);
        // Where a ray grazes the bounding body, the entry is as uncertain as the square root of rounding.
        span.begin = std::max(span.begin, hit.s - delta(hit.s));
        const oracle::Verdict founded = oracle::judge_ray(f, span, delta, {true, hit.s}, kMostProbes);
        unfounded = founded.unfounded;
        undecided_ += founded.undecided;
    }
    if (!passed.missed && !unfounded) return;
    ++violations_;
    violation_ = (unfounded ? fmt::format("f > 0 within {:.3g} of the hit at {:.17g}: ", delta(hit.s), hit.s)
                            : fmt::format("passed over [{:.17g}, {:.17g}], {:.3g} of delta: ", passed.stretch.begin,
                                          passed.stretch.end, passed.thickest)) +
                 describe();
}

std::vector<Row> RayJury::rows(const std::string& name) const {
    const double rays = std::max(1.0, static_cast<double>(rays_));
    const std::string counts = fmt::format(
        "{} rays, {} hits, {} unresolved; thickest stretch passed over {:.2g} delta; {} undecided, {} judged in part",
        rays_, hits_, unresolved_, thickest_, undecided_, cut_short_);
    // A family without rays or hits has shown nothing.
    const double broken =
        hits_ > 0 ? static_cast<double>(violations_ + unresolved_) : std::numeric_limits<double>::quiet_NaN();
    return {check(name + ": broken promises, unresolved", broken, 0.0, "rays",
                  violation_.empty() ? counts : violation_ + "; " + counts),
            information(name + ": most steps of a ray", most_steps_.value(), "steps",
                        fmt::format("mean {:.1f}; {}", steps_ / rays, most_steps_.where()))};
}

}  // namespace strata::tools::stability
