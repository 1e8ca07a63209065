// Surfaces and rays that are hard on a tracer: grazing ones, ones along silhouettes, ones that start in the thick of
// it.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "src/trace/fast_tracer.h"
#include "src/trace/field.h"
#include "src/trace/shadow_ray.h"
#include "tests/support/random.h"
#include "tests/support/surfaces.h"
#include "tools/stability/oracles/ray_oracle.h"
#include "tools/stability/oracles/shape_of.h"

namespace strata::trace_test {

using support::log_uniform;
using support::Random;
using support::uniform;
using support::unit_vector;

inline scene::Surface surface_of(solid::Kind kind) {
    scene::Surface surface;
    surface.kind = kind;
    surface.shape<solid::LevelSet>().bound_size = glm::dvec3(3.0, 2.0, 2.5);
    surface.shape<solid::Sphere>().radius = 5.0;
    return surface;
}

// The design range: 1 to 16 octaves, gain 0.3 to 0.7, lacunarity 1.7 to 3, slopes of single octaves to about 10.
inline scene::Surface random_surface(Random& random) {
    scene::Surface surface = surface_of(support::any_kind(random()));
    surface.octaves = 1 + static_cast<int>(random() % 16);
    surface.gain = uniform(random, 0.3, 0.7);
    surface.lacunarity = uniform(random, 1.7, 3.0);
    const bool bounded = solid::row_of(surface.kind).has_bound;
    surface.frequency = log_uniform(random, bounded ? 0.3 : 0.05, 2.0);
    const double growth = std::max(1.0, surface.gain * surface.lacunarity);
    const double steepest = 3.75 * surface.frequency * std::pow(growth, surface.octaves - 1);
    surface.amplitude = std::min(1.5, log_uniform(random, 0.5, 10.0) / steepest);
    surface.seed = random() >> 1;
    surface.shape<solid::LevelSet>().bound =
        random() % 2 == 0 ? solid::LevelSet::Bound::ball : solid::LevelSet::Bound::box;
    surface.shape<solid::LevelSet>().threshold = uniform(random, -0.1, 0.1) * surface.amplitude;
    return surface;
}

// The same with noise that moves through it.
inline scene::Surface random_drifting_surface(Random& random) {
    scene::Surface surface = random_surface(random);
    surface.drift = log_uniform(random, 1e-3, 1e2) * unit_vector(random);
    return surface;
}

using oracle::shape_of;

// How many rays of each family were made; one that a surface does not yield falls back on an outer one.
struct FamilyCounts {
    std::size_t outer = 0, inner = 0, grazing = 0, silhouette = 0, shadow = 0;
};

// Makes rays of five families: seen from outside, from inside the slab, grazing, next to a silhouette, and from a hit
// towards a light (with a tolerance that does not begin at 0).
class RayFamilies {
  public:
    RayFamilies(const trace::Field& field, const trace::FastTracer& tracer, double pixel_angle)
        : field_(field), tracer_(tracer), delta_slope_(0.1 * pixel_angle) {}

    std::vector<trace::Ray> make(Random& random, std::size_t count) {
        std::vector<trace::Ray> rays;
        while (rays.size() < count) {
            // A drifting field is another one at each ray's time.
            time_ = field_.drifts() ? uniform(random, -50.0, 50.0) : 0.0;
            const trace::Ray seen = outer_ray(random);
            rays.push_back(seen);
            rays.push_back(make_ray(near_point(random), unit_vector(random)));
            rays.push_back(grazing_ray(random, seen));
            rays.push_back(silhouette_ray(random, seen));
            rays.push_back(shadow_ray(random, seen));
            ++counts_.inner;
            times_.resize(rays.size(), time_);
        }
        counts_.outer = rays.size() - counts_.inner - counts_.grazing - counts_.silhouette - counts_.shadow;
        return rays;
    }

    const FamilyCounts& counts() const { return counts_; }

    // Of the rays made so far.
    const std::vector<double>& times() const { return times_; }

  private:
    trace::Ray make_ray(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const glm::dvec3 shift = field_.noise_shift(time_);
        return {.origin = origin,
                .direction = direction,
                .noise_shift = shift,
                .limit = 40.0,
                .delta0 = 0x1p-50 * glm::length(shift),
                .delta_slope = delta_slope_};
    }

    // About the surface, within a few amplitudes of it.
    glm::dvec3 near_point(Random& random) const {
        const double height = uniform(random, -0.5, 1.0) * field_.amplitude();
        if (solid::row_of(field_.surface().kind).has_bound) {
            const glm::dvec3& size = field_.surface().shape<solid::LevelSet>().bound_size;
            return uniform(random, 0.0, 1.2) * size * unit_vector(random);
        }
        return solid::over(field_.solid(), 60.0 * unit_vector(random), height);
    }

    trace::Ray outer_ray(Random& random) const {
        const glm::dvec3 target = near_point(random);
        glm::dvec3 from = target + unit_vector(random) * uniform(random, 0.5, 12.0);
        if (!solid::row_of(field_.surface().kind).has_bound) {
            const double ball = field_.extent().ball;
            const double far = std::isfinite(ball) && random() % 2 == 0 ? uniform(random, 0.0, 1.5) * ball : 0.0;
            from = solid::over(field_.solid(), from, uniform(random, 0.2, 2.0) * field_.amplitude() + 0.05 + far);
        }
        const glm::dvec3 toward = target + 0.3 * unit_vector(random) - from;
        return make_ray(from, glm::normalize(toward));
    }

    trace::Hit hit(const trace::Ray& ray) const {
        trace::Hit result;
        trace::TraceCounters counters;
        tracer_.trace({&ray, 1}, {&result, 1}, counters);
        return result;
    }

    // Along the tangent plane of a point of the surface, just above or below it.
    trace::Ray grazing_ray(Random& random, const trace::Ray& seen) {
        const trace::Hit found = hit(seen);
        if (found.state != trace::HitState::hit) return outer_ray(random);
        const glm::dvec3 x = seen.origin + found.s * seen.direction;
        const glm::dvec3 normal = glm::normalize(field_.gradient(x, seen.noise_shift));
        const glm::dvec3 tangent = glm::normalize(glm::cross(normal, unit_vector(random)));
        ++counts_.grazing;
        const double lift = log_uniform(random, 1e-7, 1e-2) * (random() % 3 == 0 ? -1.0 : 1.0);
        return make_ray(x + lift * normal - uniform(random, 0.0, 5.0) * tangent, tangent);
    }

    // Between a ray that hits and one that misses, halved until they are a small fraction of a pixel apart.
    trace::Ray silhouette_ray(Random& random, const trace::Ray& seen) {
        trace::Ray a = seen, b = seen;
        b.direction = glm::normalize(seen.direction + 0.5 * unit_vector(random));
        const bool a_hits = hit(a).state == trace::HitState::hit;
        if (a_hits == (hit(b).state == trace::HitState::hit)) return grazing_ray(random, seen);
        ++counts_.silhouette;
        const int halvings = 4 + static_cast<int>(random() % 20);
        for (int i = 0; i < halvings; ++i) {
            trace::Ray middle = seen;
            middle.direction = glm::normalize(a.direction + b.direction);
            (hit(middle).state == trace::HitState::hit) == a_hits ? a = middle : b = middle;
        }
        return random() % 2 == 0 ? a : b;
    }

    trace::Ray shadow_ray(Random& random, const trace::Ray& seen) {
        const trace::Hit found = hit(seen);
        if (found.state != trace::HitState::hit || found.on_bound) return outer_ray(random);
        const glm::dvec3 normal =
            glm::normalize(field_.gradient(seen.origin + found.s * seen.direction, seen.noise_shift));
        const glm::dvec3 light = unit_vector(random);
        ++counts_.shadow;
        return trace::shadow_ray(seen, found, normal, glm::dot(light, normal) > 0.0 ? light : -light);
    }

    const trace::Field& field_;
    const trace::FastTracer& tracer_;
    double delta_slope_;
    double time_ = 0.0;  // of the rays being made
    std::vector<double> times_;
    FamilyCounts counts_;
};

// Violations of the two promises of a tracer, by the oracle's judgement.
struct Judgement {
    std::size_t rays = 0, hits = 0, missed = 0, unfounded = 0, undecided = 0, unresolved = 0;
    double thickest = 0.0;                   // longest stretch inside that was passed over, in deltas
    glm::dvec3 origin{0.0}, direction{0.0};  // of the last violation, to replay
};

// field_at(time): a FieldOracle or what has its probe and shape. times: of each ray, or empty for time 0.
template <class FieldAt>
Judgement judge_by(const FieldAt& field_at, std::span<const trace::Ray> rays, std::span<const trace::Hit> hits,
                   std::span<const double> times) {
    double time = 0.0;
    auto field = field_at(time);
    Judgement total;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const trace::Ray& ray = rays[i];
        if (!times.empty() && times[i] != time) field = field_at(time = times[i]);
        const auto delta = [&](double t) { return ray.delta0 + ray.delta_slope * t; };
        const bool hit = hits[i].state == trace::HitState::hit;
        ++total.rays;
        total.hits += hit;
        total.unresolved += hits[i].state == trace::HitState::unresolved;
        const oracle::Verdict verdict = oracle::judge_ray(
            field, oracle::as_vec(ray.origin), oracle::as_vec(ray.direction), ray.limit, delta, {hit, hits[i].s});
        total.missed += verdict.missed;
        total.unfounded += verdict.unfounded;
        total.undecided += verdict.undecided;
        total.thickest = std::max(total.thickest, verdict.thickest);
        if (!verdict.ok()) {
            total.origin = ray.origin;
            total.direction = ray.direction;
        }
    }
    return total;
}

inline Judgement judge(const scene::Surface& surface, std::span<const trace::Ray> rays,
                       std::span<const trace::Hit> hits, std::span<const double> times = {}) {
    const auto field_at = [&](double time) { return oracle::FieldOracle(shape_of(surface, time)); };
    return judge_by(field_at, rays, hits, times);
}

}  // namespace strata::trace_test
