// The check behind test_first_hit.cpp and its longer sibling.
#pragma once

#include <doctest/doctest.h>

#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "src/trace/reference_tracer.h"
#include "tests/trace/ray_families.h"

namespace strata::trace_test {

// What both tracers promise, of the reference one.
inline void check_reference(scene::Surface surface, std::size_t count, Random& random) {
    surface.octaves = std::min(surface.octaves, 4);  // its steps shrink with the sum of slopes
    const trace::Field field(surface);
    const trace::FastTracer tracer(field);
    RayFamilies families(field, tracer, log_uniform(random, 1e-3, 5e-3));
    const std::vector<trace::Ray> rays = families.make(random, count);
    std::vector<trace::Hit> hits(rays.size());
    trace::TraceCounters counters;
    trace::trace_reference(field, rays, hits, counters);
    const Judgement found = judge(surface, rays, hits, families.times());
    CHECK(found.missed == 0);
    CHECK(found.unfounded == 0);
    CHECK(found.unresolved == 0);
}

// How many rays there were, and of them those that are not made to be hard.
struct Share {
    std::size_t rays = 0, outer = 0;
};

inline void check_surface(const scene::Surface& surface, std::size_t count, Random& random, Share& share) {
    const trace::Field field(surface);
    const trace::FastTracer tracer(field);
    const double pixel_angle = log_uniform(random, 2e-4, 5e-3);
    RayFamilies families(field, tracer, pixel_angle);
    const std::vector<trace::Ray> rays = families.make(random, count);
    std::vector<trace::Hit> hits(rays.size());
    trace::TraceCounters counters;
    tracer.trace(rays, hits, counters);
    const Judgement found = judge(surface, rays, hits, families.times());
    MESSAGE("kind " << static_cast<int>(surface.kind) << ", " << surface.octaves << " octaves, " << found.rays
                    << " rays, " << found.hits << " hits, thickest stretch passed over " << found.thickest
                    << " delta (bound 1), undecided " << found.undecided << ", evaluations a ray "
                    << static_cast<double>(counters.noise_evaluations) / static_cast<double>(rays.size()));
    INFO("seed " << surface.seed << " amplitude " << surface.amplitude << " frequency " << surface.frequency << " gain "
                 << surface.gain << " lacunarity " << surface.lacunarity << " last violation from (" << found.origin.x
                 << ' ' << found.origin.y << ' ' << found.origin.z << ") towards (" << found.direction.x << ' '
                 << found.direction.y << ' ' << found.direction.z << ')');
    CHECK(found.missed == 0);
    CHECK(found.unfounded == 0);
    CHECK(found.unresolved == 0);
    CHECK(found.undecided * 1000 <= found.rays);
    CHECK(found.hits * 10 > found.rays);
    share.rays += found.rays;
    share.outer += families.counts().outer;
}

// Noise that moves through surfaces of every kind, each ray at a time of its own; by both tracers.
inline void check_drifting_surfaces(std::size_t random_scenes, std::size_t rays_each) {
    Random random(20060102);
    Share share;
    for (std::size_t i = 0; i < random_scenes; ++i) {
        scene::Surface surface = random_drifting_surface(random);
        surface.kind = support::any_kind(static_cast<std::uint64_t>(i));
        check_surface(surface, rays_each, random, share);
        check_reference(surface, rays_each / 20, random);
    }
    CHECK(share.outer * 2 <= share.rays);
}

// The surfaces of the built-in scenes, then random ones.
inline void check_surfaces(std::size_t random_scenes, std::size_t rays_each) {
    Random random(20060101);
    Share share;
    for (const char* name : {"terrain", "hyperterrain", "planet", "isosurface"}) {
        const auto builtin = scene::find_builtin(name);
        REQUIRE(builtin);
        check_surface(scene::read_scene(builtin->text, name).surface, rays_each, random, share);
    }
    for (std::size_t i = 0; i < random_scenes; ++i) check_surface(random_surface(random), rays_each, random, share);
    CHECK(share.outer * 2 <= share.rays);
}

}  // namespace strata::trace_test
