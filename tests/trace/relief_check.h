// The check behind test_relief_tracer.cpp and its longer sibling.
#pragma once

#include <doctest/doctest.h>

#include <utility>

#include "tests/trace/relief_families.h"

namespace strata::trace_test {

// What the tracer promises, of `count` rays through a composed surface; `rays_total` counts them.
inline void check_rays(const scene::Surface& surface, std::size_t count, Random& random, std::size_t& rays_total) {
    const trace::Field field(surface);
    const trace::FastTracer tracer(field);
    RayFamilies families(field, tracer, log_uniform(random, 5e-4, 5e-3));
    const std::vector<trace::Ray> rays = families.make(random, count);
    std::vector<trace::Hit> hits(rays.size());
    trace::TraceCounters counters;
    tracer.trace(rays, hits, counters);
    const Judgement found = judge_composed(surface, rays, hits, families.times());
    MESSAGE(solid::row_of(surface.kind).name
            << ", " << surface.relief.size() << " terms, " << found.rays << " rays, " << found.hits
            << " hits, thickest stretch passed over " << found.thickest << " delta (bound 1), undecided "
            << found.undecided << ", evaluations a ray "
            << static_cast<double>(counters.noise_evaluations) / static_cast<double>(rays.size()) << ", steps a ray "
            << static_cast<double>(counters.steps) / static_cast<double>(rays.size()));
    INFO("last violation from (" << found.origin.x << ' ' << found.origin.y << ' ' << found.origin.z << ") towards ("
                                 << found.direction.x << ' ' << found.direction.y << ' ' << found.direction.z << ')');
    CHECK(found.missed == 0);
    CHECK(found.unfounded == 0);
    CHECK(found.unresolved == 0);
    CHECK(found.undecided * 500 <= found.rays);
    rays_total += found.rays;
}

inline scene::Surface plain(solid::Kind kind, std::vector<noise::ReliefTerm> relief) {
    scene::Surface surface;
    surface.kind = kind;
    surface.relief = std::move(relief);
    return surface;
}

}  // namespace strata::trace_test
