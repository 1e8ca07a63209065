// Windows of screen cells: rays that pass through them keep both promises, and what each finds is its own.
#include "src/accel/cell_windows.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/trace/fast_tracer_cases.h"
#include "tests/trace/first_hit_check.h"

using namespace strata;
using namespace strata::accel;
using namespace strata::trace_test;
using trace::Hit;
using trace::Ray;

namespace {

// A thin cone about each ray, which is anywhere in it, with windows from some place before its hit or from anywhere.
struct WindowedRays {
    std::vector<CellBeam> cells;
    WindowChains chains;
    std::vector<Ray> rays;

    WindowedRays(const trace::Field& field, std::span<const Ray> plain, std::span<const Hit> hits, double pixel_angle,
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
        CellWindows(field, 0.1 * pixel_angle).build(chains, counters);
        for (std::size_t i = 0; i < rays.size(); ++i) rays[i].window = chains.first(i);
    }
};

// What the window is off by at a point of the ray, over what it may be.
double error_share(const trace::Field& field, const trace::Window& window, const Ray& ray, double s) {
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

bool same(const Hit& a, const Hit& b) {
    return a.state == b.state && a.on_bound == b.on_bound && a.s == b.s && a.s_outside == b.s_outside &&
           a.steps == b.steps && a.noise_evaluations == b.noise_evaluations && a.gradient == b.gradient &&
           a.octaves == b.octaves;
}

// Surfaces on which windows matter: not too many octaves.
scene::Surface smooth_surface(Random& random, int index) {
    scene::Surface surface = index % 3 == 2 ? random_drifting_surface(random) : random_surface(random);
    surface.kind = static_cast<scene::SurfaceKind>(index % 4);
    surface.octaves = 1 + static_cast<int>(random() % 9);
    return surface;
}

}  // namespace

TEST_CASE("a window holds for the rays of its cell from where it begins to where it ends") {
    Random random(20061122);
    std::size_t windows = 0;
    double greatest = 0.0;
    for (int i = 0; i < 48; ++i) {
        const Case c(smooth_surface(random, i), random, 200);
        const WindowedRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
        for (const Ray& ray : with.rays) {
            for (const trace::Window* w = ray.window; w != nullptr; w = w->after(), ++windows) {
                if (w->after() != nullptr) CHECK(w->after()->from <= w->to);
                for (const double share : {0.0, 1.0, uniform(random, 0.0, 1.0)}) {
                    greatest = std::max(greatest, error_share(c.field, *w, ray, w->from + share * (w->to - w->from)));
                }
            }
        }
    }
    MESSAGE(windows << " windows, greatest error " << greatest << " of its bound");
    CHECK(windows > 5000);
    CHECK(greatest < 1.0);
    CHECK(greatest > 0.1);
}

TEST_CASE(
    "rays through windows pass over no more than delta of the surface and report no hit without one, on every "
    "target") {
    on_every_target([](const std::string& target) {
        Random random(20061119);
        std::size_t rays = 0, windowed = 0, fewer = 0, without = 0;
        double thickest = 0.0;
        for (int i = 0; i < (target == kTargets.front() ? 48 : 12); ++i) {
            const Case c(smooth_surface(random, i), random, 500);
            CAPTURE(c.surface.seed);
            const WindowedRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
            std::vector<Hit> hits(c.rays.size());
            trace::TraceCounters counters;
            c.tracer.trace(with.rays, hits, counters);
            const Judgement found = judge(c.surface, with.rays, hits, c.families.times());
            CHECK(found.missed == 0);
            CHECK(found.unfounded == 0);
            CHECK(found.unresolved == 0);
            thickest = std::max(thickest, found.thickest);
            const std::uint64_t looked_up = counters.noise_evaluations + counters.left_out.total();
            CHECK(looked_up % c.field.octaves().size() == 0);
            CHECK(counters.left_out.in_window > 0);
            rays += found.rays;
            for (std::size_t k = 0; k < hits.size(); ++k) {
                windowed += with.rays[k].window != nullptr;
                fewer += hits[k].noise_evaluations < c.hits[k].noise_evaluations;
                without += hits[k].state == trace::HitState::hit && hits[k].noise_evaluations == 0;
            }
        }
        MESSAGE(target << ": " << rays << " rays, " << windowed << " with windows, " << fewer
                       << " with fewer evaluations, " << without << " hits without any; thickest stretch passed over "
                       << thickest << " delta (bound 1)");
        CHECK(windowed * 2 > rays);
        CHECK(fewer * 5 > windowed);
    });
}

TEST_CASE("what a ray finds does not depend on whether its neighbours have windows") {
    Random random(20061120);
    for (int i = 0; i < 12; ++i) {
        const Case c(smooth_surface(random, i), random, 400);
        WindowedRays mixed(c.field, c.rays, c.hits, c.pixel_angle, random);
        for (std::size_t k = 0; k < mixed.rays.size(); k += 2) mixed.rays[k] = c.rays[k];
        std::vector<Hit> together(c.rays.size()), alone(c.rays.size());
        trace::TraceCounters counters;
        c.tracer.trace(mixed.rays, together, counters);
        for (std::size_t k = 0; k < alone.size(); ++k) {
            c.tracer.trace(std::span(mixed.rays).subspan(k, 1), std::span(alone).subspan(k, 1), counters);
            REQUIRE(same(together[k], alone[k]));
            if (k % 2 == 0) REQUIRE(same(together[k], c.hits[k]));
        }
    }
}

TEST_CASE("a shadow ray owes nothing to the windows of the ray that found its hit") {
    Random random(20061123);
    std::size_t lit = 0;
    for (int i = 0; i < 8; ++i) {
        const Case c(smooth_surface(random, i), random, 300);
        const WindowedRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
        std::vector<Ray> shadows, plain_shadows;
        for (std::size_t k = 0; k < c.rays.size(); ++k) {
            if (c.hits[k].state != trace::HitState::hit || with.rays[k].window == nullptr) continue;
            const glm::dvec3 x = c.rays[k].origin + c.hits[k].s * c.rays[k].direction;
            const glm::dvec3 normal = glm::normalize(c.field.gradient(x, c.rays[k].noise_shift));
            const glm::dvec3 to_light = glm::normalize(normal + 0.99 * unit_vector(random));
            shadows.push_back(trace::shadow_ray(with.rays[k], c.hits[k], normal, to_light));
            plain_shadows.push_back(trace::shadow_ray(c.rays[k], c.hits[k], normal, to_light));
        }
        const Traced found = trace_all(c.tracer, shadows), plain = trace_all(c.tracer, plain_shadows);
        for (std::size_t k = 0; k < shadows.size(); ++k) {
            CHECK(shadows[k].window == nullptr);
            CHECK(same(found.hits[k], plain.hits[k]));
        }
        lit += shadows.size();
    }
    CHECK(lit > 500);
}

TEST_CASE("normals of hits in windows are of the noise, not of the window's polynomial") {
    Random random(20061121);
    scene::Surface surface = surface_of(scene::SurfaceKind::hyperterrain);
    surface.octaves = 6;
    surface.amplitude = 0.5;
    surface.frequency = 0.7;
    const Case c(surface, random, 2000);
    const WindowedRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
    std::vector<Hit> hits(c.rays.size());
    trace::TraceCounters counters;
    c.tracer.trace(with.rays, hits, counters);
    std::size_t count = 0;
    for (std::size_t k = 0; k < hits.size(); ++k) {
        if (hits[k].state != trace::HitState::hit || hits[k].noise_evaluations > 0) continue;
        const glm::dvec3 x = with.rays[k].origin + hits[k].s * with.rays[k].direction;
        std::vector<glm::vec3> gradient(1);
        c.tracer.gradients(std::span(hits).subspan(k, 1), std::span(&x, 1), {}, gradient, counters);
        CHECK(glm::distance(c.field.gradient(x), glm::dvec3(gradient[0])) < 1e-4);
        ++count;
    }
    CHECK(count > 200);
}
