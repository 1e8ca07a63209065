// The shadow of a surface on itself: no acne, no light leaks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/trace/shadow_ray.h"
#include "tools/stability/case.h"
#include "tools/stability/oracles/ray_oracle.h"
#include "tools/stability/oracles/shape_of.h"
#include "tools/stability/ray_jury.h"

namespace strata::tools::stability {

namespace {

enum class Light { lit, shadowed, unsure };

// One pixel's way to the sun, as the renderer goes it.
struct Decision {
    WorldRay pixel;
    trace::Ray seen, to_sun;
    trace::Hit hit, blocked;
};

std::vector<Decision> decisions(const RayJury& jury, Random& random, int count) {
    const scene::Film& film = jury.scene().film;
    const glm::dmat3& orientation = jury.image().placement().resting_orientation();
    const glm::dvec3 sun =
        trace::Placement::direction_to_local(orientation, glm::normalize(jury.scene().sun.direction));
    std::vector<Decision> found;
    for (int i = 0; i < count; ++i) {
        Decision d;
        d.pixel.pixel = glm::ivec2(static_cast<int>(random() % static_cast<unsigned>(film.width)),
                                   static_cast<int>(random() % static_cast<unsigned>(film.height)));
        d.seen = jury.local(d.pixel);
        d.hit = jury.trace({&d.seen, 1}).front();
        if (d.hit.state != trace::HitState::hit || d.hit.on_bound || d.hit.s == 0.0) continue;
        const glm::dvec3 x = d.seen.origin + d.hit.s * d.seen.direction;
        glm::vec3 normal;
        trace::TraceCounters counters;
        jury.image().normals({&d.hit, 1}, {&x, 1}, {}, {&normal, 1}, counters);
        if (glm::dot(glm::dvec3(normal), sun) <= 0.0) continue;
        d.to_sun = trace::shadow_ray(d.seen, d.hit, glm::dvec3(normal), sun);
        d.blocked = jury.trace({&d.to_sun, 1}).front();
        found.push_back(d);
    }
    return found;
}

class ShadowOracle {
  public:
    explicit ShadowOracle(const scene::Surface& surface) : field_(oracle::shape_of(surface)) {}

    double value(const glm::dvec3& x) const { return field_.value<double>(oracle::as_vec(x)); }

    // shadowed: a stretch inside that is longer than delta; lit: none is met.
    Light towards_sun(const trace::Ray& to_sun, const glm::dvec3& from) const {
        if (value(from) <= 0.0) return Light::unsure;
        const auto delta = [&](double s) { return to_sun.delta0 + to_sun.delta_slope * s; };
        const oracle::Verdict verdict = oracle::judge_ray(
            field_, oracle::as_vec(from), oracle::as_vec(to_sun.direction), to_sun.limit, delta, {false, 0.0}, 100000);
        if (verdict.missed) return Light::shadowed;
        return verdict.thickest > 0.0 || verdict.cut_short ? Light::unsure : Light::lit;
    }

    // The first point of the surface along the ray that saw it, from the last one known to be outside; just outside.
    std::optional<double> root(const Decision& d) const {
        const double delta = d.seen.delta0 + d.seen.delta_slope * d.hit.s;
        double outside = d.hit.s_outside, inside = outside;
        const auto f = [&](double s) { return value(d.seen.origin + s * d.seen.direction); };
        if (f(outside) <= 0.0) return std::nullopt;
        while (f(inside) > 0.0) {
            outside = inside;
            inside += delta / 64.0;
            if (inside > d.hit.s + 2.0 * delta || inside == outside) return std::nullopt;
        }
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (outside + inside);
            (f(middle) > 0.0 ? outside : inside) = middle;
        }
        return outside;
    }

  private:
    oracle::FieldOracle field_;
};

// From the exact root, from delta before it, and from where the renderer leaves: where all agree, delta does not
// decide. Against the promises (src/README.md) from the renderer's own start a decision that differs then is
// impossible: a stretch longer than delta may not be passed over, and what is said to block the light must be there. So
// the bound is 0.
std::vector<Row> self_shadow(const SceneSpec& spec, const std::string& name, const Settings& settings, Random& random) {
    RayJury jury(spec, settings);
    const ShadowOracle truth(jury.scene().surface);
    Worst acne, leak;
    int shadowed = 0, within = 0, differs = 0, points = 0;
    for (const Decision& d : decisions(jury, random, settings.trials(6000, 300))) {
        if (settings.cancelled()) return {};
        const auto root = truth.root(d);
        if (!root) continue;
        ++points;
        const bool claimed = d.blocked.state != trace::HitState::miss;
        const auto along = [&](double s) { return d.seen.origin + s * d.seen.direction; };
        const double delta = d.seen.delta0 + d.seen.delta_slope * d.hit.s;
        const Light exact = truth.towards_sun(d.to_sun, along(*root));
        const Light before = truth.towards_sun(d.to_sun, along(std::max(0.0, *root - delta)));
        const Light own = truth.towards_sun(d.to_sun, d.to_sun.origin);
        shadowed += claimed;
        differs += exact != Light::unsure && (exact == Light::shadowed) != claimed;
        const bool agree = exact == before && before == own && own != Light::unsure;
        within += !agree;
        const auto replay = [&] { return jury.replay(d.pixel); };
        if (agree) acne.see(claimed && own == Light::lit ? 1.0 : 0.0, replay);
        if (agree) leak.see(!claimed && own == Light::shadowed ? 1.0 : 0.0, replay);
        jury.judge_claim(d.to_sun, d.blocked, 0.0, replay);
    }
    const double n = std::max(1, points);
    std::vector<Row> rows = jury.rows(name + ", shadow rays");
    const std::string counts = fmt::format("{} points that face the sun, {} in shadow", points, shadowed);
    rows.push_back(
        check(name + ": acne where delta does not decide", acne.value(), 0.0, "points", counts + "; " + acne.where()));
    rows.push_back(check(name + ": light leaks where delta does not decide", leak.value(), 0.0, "points",
                         counts + "; " + leak.where()));
    rows.push_back(information(name + ": delta decides", 100.0 * within / n, "% of points", counts));
    rows.push_back(
        information(name + ": differs from the exact point's light", 100.0 * differs / n, "% of points", counts));
    return rows;
}

// A plane and spheres without noise, which shade nothing that faces the sun: beyond delta / radius, by which the light
// turns between the last point outside and the hit.
std::vector<Row> smooth(const SceneSpec& spec, const std::string& name, const Settings& settings, Random& random) {
    const RayJury jury(spec, settings);
    const trace::Field& field = jury.field();
    const double radius = field.extent().ball;
    Worst worst;
    int points = 0, false_shadows = 0;
    for (const Decision& d : decisions(jury, random, settings.trials(20000, 1000))) {
        const glm::dvec3 x = d.seen.origin + d.hit.s * d.seen.direction;
        const glm::dvec3 normal = field.base_gradient(x);
        const double turn = (d.seen.delta0 + d.seen.delta_slope * d.hit.s) / radius;
        if (glm::dot(normal, d.to_sun.direction) <= turn) continue;
        ++points;
        const bool shadowed = d.blocked.state != trace::HitState::miss;
        false_shadows += shadowed;
        if (shadowed) worst.see(1.0, [&] { return jury.replay(d.pixel); });
    }
    const double measured = points > 0 ? static_cast<double>(false_shadows) : std::nan("");
    return {check(name + ": in shadow though they face the sun", measured, 0.0, "points",
                  fmt::format("{} points; {}", points, worst.where()))};
}

SceneSpec spec_of(const std::string& name, std::vector<std::string> sets) {
    sets.insert(sets.begin(), {"surface.spin_deg_per_s=0", "film.width=1920", "film.height=1080"});
    return {name, std::move(sets)};
}

}  // namespace

void add_shadow_cases(std::vector<Case>& cases) {
    const auto add = [&](const std::string& name, const SceneSpec& spec, auto run) {
        cases.push_back({"shadow", name, [=](const Settings& s, Random& r) { return run(spec, name, s, r); }});
    };
    add("terrain, sun of the scene", spec_of("terrain", {}), self_shadow);
    add("terrain, sun 3 degrees high", spec_of("terrain", {"sun.direction=[-1,0.0524,0.2]"}), self_shadow);
    add("hyperterrain", spec_of("hyperterrain", {}), self_shadow);
    add("planet", spec_of("planet", {}), self_shadow);
    add("isosurface", spec_of("isosurface", {}), self_shadow);
    const std::vector<std::string> earth = {"surface.radius=6.371e6",
                                            "surface.frequency=1e-5",
                                            "surface.octaves=18",
                                            "surface.amplitude=3000",
                                            "camera.far=1e8",
                                            "camera.look_at=[0,5.9e6,2e6]",
                                            "camera.position=[0,6.771e6,0]",
                                            "sun.direction=[1,0.05,0.1]"};
    add("Earth from orbit", spec_of("planet", earth), self_shadow);
    add("plane, grazing sun", spec_of("terrain", {"surface.amplitude=0", "sun.direction=[1,1e-9,0]"}), smooth);
    add("plane seen from 1e8",
        spec_of("terrain", {"surface.amplitude=0", "camera.position=[0,1e8,0]", "camera.look_at=[1e8,0,1e8]",
                            "camera.far=1e12", "sun.direction=[1,1e-6,0]"}),
        smooth);
    std::vector<std::string> ball = earth;
    ball.emplace_back("surface.amplitude=0");
    add("Earth without relief from orbit", spec_of("planet", ball), smooth);
    ball.insert(ball.end(),
                {"camera.position=[0,6371002,0]", "camera.look_at=[0,6371001,100]", "sun.direction=[1,1e-4,0]"});
    add("Earth without relief from 2 m", spec_of("planet", ball), smooth);
}

}  // namespace strata::tools::stability
