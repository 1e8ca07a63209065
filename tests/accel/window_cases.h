// Rays in thin cones with windows, and what is found by these.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "src/accel/cell_windows.h"
#include "src/trace/window_tracer.h"
#include "tests/trace/ray_families.h"

namespace strata::accel_test {

using accel::CellBeam;
using accel::CellWindows;
using accel::WindowChains;
using trace::Hit;
using trace::Ray;
using trace_test::log_uniform;
using trace_test::Random;
using trace_test::random_drifting_surface;
using trace_test::random_surface;
using trace_test::RayFamilies;
using trace_test::uniform;
using trace_test::unit_vector;

// A thin cone about each ray, which is anywhere in it, with windows from some place before its hit or from anywhere.
struct ConesOfRays {
    std::vector<CellBeam> cells;
    WindowChains chains;
    std::vector<Ray> rays;
    std::vector<trace::WindowedRays> groups;  // of each ray by itself

    ConesOfRays(const trace::Field& field, std::span<const Ray> plain, std::span<const Hit> hits, double pixel_angle,
                Random& random)
        : cells(plain.size()), rays(plain.begin(), plain.end()) {
        chains.chains.resize(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double spread = pixel_angle * log_uniform(random, 0.01, 1.0);
            const glm::dvec3 off = 0.999 * spread * uniform(random, 0.0, 1.0) *
                                   glm::normalize(glm::cross(rays[i].direction, unit_vector(random)));
            trace::Beam& beam = cells[i].beam;
            beam.direction = glm::normalize(rays[i].direction + off);
            // As though eye and noise had moved by some.
            if (random() % 4 == 0) beam.radius0 = spread * log_uniform(random, 1e-3, 1.0);
            if (random() % 4 == 0) beam.noise_radius = spread * log_uniform(random, 1e-2, 30.0);
            cells[i].margins.shift = 2.0 * beam.radius0;
            beam.origin = rays[i].origin + 0.999 * beam.radius0 * unit_vector(random) - beam.radius0 * beam.direction;
            beam.noise_shift = rays[i].noise_shift + 0.999 * beam.noise_radius * unit_vector(random);
            beam.spread = spread;
            beam.limit = rays[i].limit;
            cells[i].margins.cosine = 1.0 / std::sqrt(1.0 + spread * spread);
            const bool is_anywhere = random() % 4 == 0;
            const double from = is_anywhere ? uniform(random, 0.0, 1.0) * rays[i].limit
                                            : hits[i].s_outside * (1.0 - log_uniform(random, 1e-4, 0.1));
            // As from the end of a beam.
            if (!is_anywhere && random() % 2 == 0) rays[i].start = from;
            chains.chains[i] = {.cell = &cells[i], .s = from, .slope = -uniform(random, 0.0, 1.0)};
        }
        trace::TraceCounters counters;
        CellWindows(field).build(chains, counters);
        for (std::size_t i = 0; i < rays.size(); ++i) groups.push_back({i, i + 1, chains.first(i)});
    }
};

// What the window is off by at a point of the ray, over what it may be.
inline double error_share(const trace::Field& field, const trace::Window& window, const Ray& ray, double s) {
    const glm::dvec3 x = ray.origin + s * ray.direction + ray.noise_shift, off = x - window.centre;
    const auto& h = window.hessian;
    const glm::dmat3 hessian(h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2]);
    const double found =
        static_cast<double>(window.value) + glm::dot(glm::dvec3(window.gradient) + 0.5 * (hessian * off), off);
    double noise = 0.0;
    for (std::size_t k = 0; k < field.octaves().size(); ++k) noise += field.octave(k, x);
    return std::abs(found - noise) / static_cast<double>(window.error);
}

struct Case {
    scene::Surface surface;
    trace::Field field;
    trace::FastTracer tracer;
    double pixel_angle;
    RayFamilies families;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    trace::TraceCounters counters;

    Case(const scene::Surface& s, Random& random, std::size_t count)
        : surface(s),
          field(surface),
          tracer(field),
          pixel_angle(log_uniform(random, 2e-4, 5e-3)),
          families(field, tracer, pixel_angle),
          rays(families.make(random, count)),
          hits(rays.size()) {
        tracer.trace(rays, hits, counters);
    }
};

inline bool same(const Hit& a, const Hit& b) {
    return a.state == b.state && a.on_bound == b.on_bound && a.s == b.s && a.s_outside == b.s_outside &&
           a.steps == b.steps && a.noise_evaluations == b.noise_evaluations && a.gradient == b.gradient &&
           a.octaves == b.octaves;
}

// Of rays by their windows; of those that windows did not settle by the fast tracer.
struct TracedByWindows {
    std::vector<Hit> hits;
    std::vector<bool> settled;
    trace::TraceCounters counters;

    TracedByWindows(const Case& c, std::vector<Ray> rays, std::span<const trace::WindowedRays> groups)
        : hits(rays.size()), settled(rays.size(), true) {
        trace::WindowTracerWork work;
        trace::WindowTracer(c.field).trace(rays, groups, hits, work, counters);
        for (const std::uint32_t i : work.open) {
            settled[i] = false;
            c.tracer.trace(std::span(rays).subspan(i, 1), std::span(hits).subspan(i, 1), counters);
        }
    }
};

// Surfaces on which windows matter: not too many octaves.
inline scene::Surface smooth_surface(Random& random, int index) {
    scene::Surface surface = index % 3 == 2 ? random_drifting_surface(random) : random_surface(random);
    surface.kind = support::any_kind(static_cast<std::uint64_t>(index));
    surface.octaves = 1 + static_cast<int>(random() % 9);
    return surface;
}

}  // namespace strata::accel_test
