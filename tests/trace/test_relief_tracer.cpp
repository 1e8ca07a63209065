// Rays, beams and normals of composed reliefs, against an oracle that reads the reliefs itself.
#include <doctest/doctest.h>

#include "src/trace/beam_tracer.h"
#include "tests/trace/relief_check.h"

using namespace strata;
using namespace strata::trace_test;

TEST_CASE("no ray passes over a ridged or a warped relief, and every hit is on it") {
    Random random(11);
    std::size_t rays = 0;
    for (const auto kind : {solid::kKind<solid::HeightField>, solid::kKind<solid::DisplacedPlane>}) {
        noise::Ridged ridged;
        ridged.parameters = {.octaves = 6, .gain = 0.46, .amplitude = 1.4, .frequency = 0.3, .seed = 7};
        check_rays(plain(kind, {{"ridges", {}, ridged}}), 1500, random, rays);
        noise::Fbm hills;
        noise::Warp warp;
        check_rays(plain(kind, {{"hills", {}, hills}, {"bent", {"hills"}, warp}}), 1500, random, rays);
        check_rays(plain(kind, {{"ridges", {}, ridged}, {"bent", {"ridges"}, warp}}), 1500, random, rays);
    }
    MESSAGE("rays in all: " << rays);
}

TEST_CASE("no ray passes over random compositions of terms, on every kind of surface") {
    Random random(12);
    std::size_t rays = 0;
    for (int i = 0; i < 12; ++i) check_rays(random_composed_surface(random), 400, random, rays);
    MESSAGE("rays in all: " << rays);
}

TEST_CASE("no ray passes over a composed relief whose noise drifts") {
    Random random(16);
    std::size_t rays = 0;
    for (int i = 0; i < 8; ++i) {
        scene::Surface surface = random_composed_surface(random);
        surface.drift = log_uniform(random, 1e-3, 10.0) * unit_vector(random);
        check_rays(surface, 200, random, rays);
    }
    MESSAGE("rays in all: " << rays);
}

TEST_CASE("no ray passes over gullies, envelopes and filled valleys") {
    Random random(15);
    std::size_t rays = 0;
    for (int i = 0; i < 10; ++i) {
        scene::Surface surface;
        surface.relief = random_landform(random, 2);
        check_rays(surface, 60, random, rays);
    }
    MESSAGE("rays in all: " << rays);
}

TEST_CASE("a lone fBm as a term is the surface of the keys of [surface]") {
    Random random(13);
    for (int i = 0; i < 4; ++i) {
        scene::Surface surface = random_surface(random);
        scene::Surface composed = surface;
        noise::Fbm fbm;
        fbm.parameters = {.octaves = surface.octaves,
                          .lacunarity = surface.lacunarity,
                          .gain = surface.gain,
                          .amplitude = surface.amplitude,
                          .frequency = surface.frequency,
                          .seed = surface.seed};
        composed.relief = {{"fbm", {}, fbm}};
        const trace::Field a(surface), b(composed);
        const trace::FastTracer tracer(b);
        double worst = 0.0;
        for (int j = 0; j < 200; ++j) {
            const glm::dvec3 x = 20.0 * unit_vector(random);
            CHECK(a.value(x) == doctest::Approx(b.value(x)).epsilon(1e-12));
            glm::vec3 gradient;
            trace::TraceCounters counters;
            tracer.gradients({&x, 1}, {&gradient, 1}, counters);
            worst = std::max(worst, glm::length(glm::dvec3(gradient) - a.gradient(x)) / a.lipschitz());
        }
        CHECK(worst < 1e-4);
    }
}

TEST_CASE("within a beam's free stretch no point is inside a composed relief") {
    Random random(14);
    std::size_t points = 0;
    for (int i = 0; i < 12; ++i) {
        scene::Surface surface = random_composed_surface(random);
        if (i % 2 == 0) {
            surface = {};
            surface.relief = random_landform(random);
        }
        if (i % 3 == 0) surface.drift = {0.3, 0.1, -0.2};
        const trace::Field field(surface);
        const trace::FastTracer rays(field);
        const trace::BeamTracer beams(field);
        RayFamilies families(field, rays, 1e-3);
        for (const trace::Ray& ray : families.make(random, 60)) {
            const double radius0 = random() % 2 == 0 ? 0.0 : log_uniform(random, 1e-4, 0.1);
            const trace::Interval inside = field.clip(ray.origin, ray.direction, ray.limit);
            if (inside.begin >= inside.end) continue;
            const double noise_radius = field.drifts() ? log_uniform(random, 1e-4, 0.1) : 0.0;
            const trace::Beam beam{.origin = ray.origin,
                                   .direction = ray.direction,
                                   .noise_shift = ray.noise_shift,
                                   .radius0 = radius0,
                                   .spread = log_uniform(random, 1e-4, 0.05),
                                   .noise_radius = noise_radius,
                                   .start = inside.begin,
                                   .limit = inside.end};
            trace::BeamEnd end;
            trace::TraceCounters counters;
            beams.trace({&beam, 1}, {&end, 1}, counters);
            const glm::dvec3 side = glm::normalize(glm::cross(beam.direction, unit_vector(random)));
            const glm::dvec3 other = glm::cross(beam.direction, side);
            for (int j = 0; j < 40 && end.s > beam.start; ++j) {
                const double s = uniform(random, beam.start, std::min(end.s, beam.limit));
                const double angle = uniform(random, 0.0, 6.283185307179586);
                const double r = (beam.radius0 + beam.spread * s) * (j % 2 == 0 ? 1.0 : uniform(random, 0.0, 1.0));
                const glm::dvec3 x =
                    beam.origin + s * beam.direction + r * (std::cos(angle) * side + std::sin(angle) * other);
                REQUIRE(field.value(x, ray.noise_shift + noise_radius * unit_vector(random)) > 0.0);
                ++points;
            }
        }
    }
    MESSAGE("points: " << points);
    CHECK(points > 2000);
}

TEST_CASE("a ray that starts closer to a relief than float can tell comes away from it") {
    noise::Ridged ridged;
    ridged.parameters = {.octaves = 5, .gain = 0.46, .amplitude = 1.4, .frequency = 0.3, .seed = 7};
    for (const auto kind : {solid::kKind<solid::HeightField>, solid::kKind<solid::DisplacedPlane>}) {
        const trace::Field field(plain(kind, {{"ridges", {}, ridged}}));
        const trace::FastTracer tracer(field);
        Random random(17);
        for (int i = 0; i < 50; ++i) {
            glm::dvec3 x{uniform(random, -9.0, 9.0), 0.0, uniform(random, -9.0, 9.0)};
            double low = -3.0, high = 3.0;  // field < 0 at low, > 0 at high
            while (high - low > 1e-10) {
                x.y = 0.5 * (low + high);
                (field.value(x) > 0.0 ? high : low) = x.y;
            }
            x.y = high;
            const trace::Ray ray{.origin = x, .direction = {0.0, 1.0, 0.0}, .limit = 40.0, .delta_slope = 1e-4};
            trace::Hit hit;
            trace::TraceCounters counters;
            tracer.trace({&ray, 1}, {&hit, 1}, counters);
            CHECK(hit.state == trace::HitState::miss);
        }
    }
}
