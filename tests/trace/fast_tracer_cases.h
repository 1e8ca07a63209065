// What the tests of the fast tracer share: every SIMD target in turn, traced batches, hard surfaces and rays.
#pragma once

#include <doctest/doctest.h>

#include <span>
#include <string>
#include <vector>

#include "noise/simd_target.h"
#include "tests/trace/ray_families.h"

namespace strata::trace_test {

// Asked before any is pinned.
inline const std::vector<std::string> kTargets = noise::simd_targets();

template <class Body>
void on_every_target(const Body& body) {
    for (const std::string& target : kTargets) {
        REQUIRE(noise::pin_simd_target(target));
        CAPTURE(target);
        body(target);
    }
    REQUIRE(noise::pin_simd_target(kTargets.front()));
}

struct Traced {
    std::vector<trace::Hit> hits;
    trace::TraceCounters counters;
};

inline Traced trace_all(const trace::FastTracer& tracer, std::span<const trace::Ray> rays) {
    Traced result;
    result.hits.resize(rays.size());
    tracer.trace(rays, result.hits, result.counters);
    return result;
}

inline double delta(const trace::Ray& ray, double s) { return ray.delta0 + ray.delta_slope * s; }

// The default surface of each kind, then random ones.
inline std::vector<scene::Surface> surfaces(Random& random, int random_count) {
    std::vector<scene::Surface> all;
    for (const solid::Kind kind : support::all_kinds()) all.push_back(surface_of(kind));
    for (int i = 0; i < random_count; ++i) all.push_back(random_surface(random));
    return all;
}

inline std::vector<trace::Ray> hard_rays(Random& random, const trace::Field& field, const trace::FastTracer& tracer,
                                         std::size_t count) {
    return RayFamilies(field, tracer, log_uniform(random, 3e-4, 5e-3)).make(random, count);
}

}  // namespace strata::trace_test
