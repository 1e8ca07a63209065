// The fast tracer beyond its two promises (test_first_hit.cpp): same bits in any company, exact cases, what a hit says
// of itself, and what it costs.
#include "src/trace/fast_tracer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"
#include "src/trace/camera.h"
#include "tests/trace/fast_tracer_cases.h"

using namespace strata;
using namespace strata::trace_test;
using trace::Hit;
using trace::HitState;
using trace::Ray;

namespace {

bool same(const Hit& a, const Hit& b) {
    return a.state == b.state && a.on_bound == b.on_bound && a.s == b.s && a.s_outside == b.s_outside &&
           a.steps == b.steps && a.noise_evaluations == b.noise_evaluations;
}

}  // namespace

TEST_CASE("a ray's hit has the same bits in batches of 1 to 64, in any order, beside far rays, on every target") {
    on_every_target([](const std::string&) {
        Random random(51);
        for (const scene::Surface& surface : surfaces(random, 4)) {
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            std::vector<Ray> rays = hard_rays(random, field, tracer, 192);
            // Rays whose cells lie beyond the first block of the hash, rays without length, rays that miss the clip.
            for (std::size_t i = 0; i < rays.size(); i += 23) {
                rays[i].origin += glm::dvec3(0x1p31 / surface.frequency, 0.0, 0.0);
                rays[(i + 5) % rays.size()].limit = 0.0;
            }
            std::vector<Hit> alone(rays.size());
            trace::TraceCounters counters;
            for (std::size_t i = 0; i < rays.size(); ++i) tracer.trace({&rays[i], 1}, {&alone[i], 1}, counters);
            std::vector<std::size_t> order(rays.size());
            std::iota(order.begin(), order.end(), std::size_t{0});
            int different = 0;
            for (int round = 0; round < 4; ++round) {
                std::shuffle(order.begin(), order.end(), random);
                for (std::size_t begin = 0, size = 1; begin < rays.size(); begin += size, size = 1 + random() % 64) {
                    std::vector<Ray> batch;
                    for (std::size_t i = begin; i < std::min(begin + size, rays.size()); ++i) {
                        batch.push_back(rays[order[i]]);
                    }
                    const Traced found = trace_all(tracer, batch);
                    for (std::size_t i = 0; i < batch.size(); ++i) {
                        different += !same(found.hits[i], alone[order[begin + i]]);
                    }
                }
            }
            CHECK(different == 0);
        }
    });
}

TEST_CASE("counters are the sum over the rays, and no more lanes do work than are executed") {
    on_every_target([](const std::string&) {
        Random random(52);
        for (const scene::Surface& surface : surfaces(random, 4)) {
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            const Traced found = trace_all(tracer, hard_rays(random, field, tracer, 300));
            std::uint64_t evaluations = 0, steps = 0;
            for (const Hit& hit : found.hits) {
                evaluations += hit.noise_evaluations;
                steps += hit.steps;
            }
            CHECK(found.counters.noise_evaluations == evaluations);
            CHECK(found.counters.steps == steps);
            CHECK(found.counters.executed_lanes >= evaluations);
            CHECK(evaluations > 0);
        }
    });
}

TEST_CASE(
    "s_outside lies outside the surface, at most delta before the hit, or is the hit where the ray starts inside") {
    on_every_target([](const std::string& target) {
        Random random(55);
        double widest = 0.0;
        int hits = 0, inside = 0, on_bound = 0;
        for (const scene::Surface& surface : surfaces(random, 6)) {
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            const oracle::FieldOracle expected(shape_of(surface));
            const std::vector<Ray> rays = hard_rays(random, field, tracer, 400);
            const Traced found = trace_all(tracer, rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Hit& hit = found.hits[i];
                if (hit.state != HitState::hit) continue;
                ++hits;
                const auto f_at = [&](double s) {
                    const glm::dvec3 x = rays[i].origin + s * rays[i].direction;
                    return static_cast<double>(expected.value<long double>({x.x, x.y, x.z}));
                };
                REQUIRE(hit.s_outside <= hit.s);
                REQUIRE(hit.s >= 0.0);
                REQUIRE(hit.s < rays[i].limit);
                if (hit.steps == 1) {
                    REQUIRE(hit.s_outside == hit.s);
                    // Inside at the start of the ray or of its part within the bound. Double cannot tell |f| < 1e-13.
                    inside += !hit.on_bound;
                    on_bound += hit.on_bound;
                    REQUIRE(f_at(hit.s) <= 1e-13);
                    REQUIRE(hit.on_bound == (hit.s > 0.0 && solid::row_of(surface.kind).has_bound));
                    continue;
                }
                REQUIRE(!hit.on_bound);
                REQUIRE(f_at(hit.s_outside) > -1e-13);
                const double width = (hit.s - hit.s_outside) / delta(rays[i], hit.s);
                widest = std::max(widest, width);
            }
        }
        MESSAGE(target << ": " << hits << " hits, " << inside << " from inside, " << on_bound
                       << " on a bound; s - s_outside at most " << widest << " delta");
        CHECK(widest <= 1.0 + 1e-9);
        CHECK(inside > 50);
        CHECK(on_bound > 20);
    });
}

TEST_CASE("rays that start inside or exactly on the surface hit at 0 in one step") {
    on_every_target([](const std::string&) {
        Random random(56);
        for (const scene::Surface& surface : surfaces(random, 8)) {
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            const oracle::FieldOracle expected(shape_of(surface));
            int found_inside = 0;
            for (int i = 0; i < 300; ++i) {
                glm::dvec3 x = 2.0 * unit_vector(random);
                if (!solid::row_of(surface.kind).is_level) x *= uniform(random, 0.0, 2.4);
                if (expected.value({x.x, x.y, x.z}) > -1e-12) continue;
                if (solid::row_of(surface.kind).has_bound && glm::length(x) > 1.99 + 1.0) continue;
                const Ray ray{.origin = x, .direction = unit_vector(random), .limit = 5.0, .delta_slope = 1e-4};
                const Traced traced = trace_all(tracer, {&ray, 1});
                if (field.clip(ray.origin, ray.direction, ray.limit).begin > 0.0) continue;
                ++found_inside;
                REQUIRE(traced.hits[0].state == HitState::hit);
                REQUIRE(traced.hits[0].s == 0.0);
                REQUIRE(traced.hits[0].s_outside == 0.0);
                REQUIRE(traced.hits[0].steps == 1);
                REQUIRE(!traced.hits[0].on_bound);
            }
            CHECK(found_inside > 10);
        }
    });
    scene::Surface flat = surface_of(solid::kKind<solid::HeightField>);
    flat.amplitude = 0.0;
    const trace::Field field(flat);
    const trace::FastTracer tracer(field);
    for (const glm::dvec3& direction : {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0)}) {
        const Ray ray{.origin = {4.0, 0.0, 1.0}, .direction = direction, .limit = 5.0, .delta_slope = 1e-4};
        const Hit hit = trace_all(tracer, {&ray, 1}).hits[0];
        CHECK(hit.state == HitState::hit);
        CHECK(hit.s == 0.0);
    }
}

TEST_CASE("a ray without length misses, and one that ends before its hit misses") {
    Random random(57);
    for (const scene::Surface& surface : surfaces(random, 8)) {
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        std::vector<Ray> rays = hard_rays(random, field, tracer, 300);
        const Traced whole = trace_all(tracer, rays);
        int shortened = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            Ray ray = rays[i];
            ray.limit = 0.0;
            REQUIRE(trace_all(tracer, {&ray, 1}).hits[0].state == HitState::miss);
            const Hit& hit = whole.hits[i];
            if (hit.state != HitState::hit || hit.s_outside <= 0.0 || hit.s == hit.s_outside) continue;
            ray.limit = hit.s_outside * uniform(random, 0.5, 1.0);
            REQUIRE(trace_all(tracer, {&ray, 1}).hits[0].state == HitState::miss);
            // Past it by a tolerance, nothing changes.
            ray.limit = hit.s + 4.0 * delta(ray, hit.s) + 1e-9;
            REQUIRE(same(trace_all(tracer, {&ray, 1}).hits[0], hit));
            ++shortened;
        }
        CHECK(shortened > 30);
    }
}

TEST_CASE("without octaves, planes and spheres are hit where algebra says, without a noise evaluation") {
    on_every_target([](const std::string& target) {
        Random random(58);
        double worst_plane = 0.0, worst_sphere = 0.0;
        int hits = 0;
        for (int trial = 0; trial < 3000; ++trial) {
            const bool plane = trial % 2 == 0;
            scene::Surface surface = surface_of(plane ? solid::kKind<solid::HeightField> : solid::kKind<solid::Sphere>);
            surface.amplitude = 0.0;
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            Ray ray{.origin = uniform(random, 6.0, 30.0) * unit_vector(random),
                    .direction = unit_vector(random),
                    .limit = 1000.0,
                    .delta_slope = 1e-4};
            if (plane) ray.origin.y = log_uniform(random, 1e-6, 10.0);
            if (!plane) ray.direction = glm::normalize(4.9 * unit_vector(random) - ray.origin);
            const Traced found = trace_all(tracer, {&ray, 1});
            CHECK(found.counters.noise_evaluations == 0);
            double exact = plane ? -ray.origin.y / ray.direction.y : 0.0;
            if (!plane) {
                const double middle = -glm::dot(ray.origin, ray.direction);
                exact = middle - std::sqrt(middle * middle + 25.0 - glm::dot(ray.origin, ray.origin));
            }
            const bool expected = exact > 0.0 && exact < ray.limit;
            REQUIRE((found.hits[0].state == HitState::hit) == expected);
            if (!expected) continue;
            ++hits;
            double& worst = plane ? worst_plane : worst_sphere;
            worst = std::max(worst, std::abs(found.hits[0].s - exact) / delta(ray, exact));
        }
        MESSAGE(target << ": " << hits << " hits, off by at most " << worst_plane << " delta on planes, "
                       << worst_sphere << " on spheres");
        CHECK(hits > 1500);
        CHECK(worst_plane < 1e-3);
        CHECK(worst_sphere <= 1.0);
    });
}

TEST_CASE("the benchmark scene takes at most 220 noise evaluations a ray, normals included, on every target") {
    const scene::Scene scene = scene::read_scene(scene::find_builtin("hyperterrain")->text, "hyperterrain");
    const trace::Field field(scene.surface);
    const trace::FastTracer tracer(field);
    const trace::Camera camera(scene.camera, {.width = 480, .height = 270});
    std::vector<Ray> rays;
    for (int y = 2; y < 270; y += 5) {
        for (int x = 2; x < 480; x += 5) {
            const trace::CameraRay seen = camera.ray(x + 0.5, y + 0.5);
            rays.push_back({.origin = camera.position(),
                            .direction = seen.direction,
                            .limit = scene.camera.far,
                            .delta_slope = scene.sampling.tolerance * seen.pixel_angle});
        }
    }
    on_every_target([&](const std::string& target) {
        Traced found = trace_all(tracer, rays);
        std::vector<glm::dvec3> x;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (found.hits[i].state == HitState::hit) x.push_back(rays[i].origin + found.hits[i].s * rays[i].direction);
        }
        std::vector<glm::vec3> normals(x.size());
        const std::uint64_t traced = found.counters.noise_evaluations;
        tracer.gradients(x, normals, found.counters);
        const auto count = static_cast<double>(rays.size());
        MESSAGE(target << ": " << static_cast<double>(traced) / count << " evaluations a ray to trace, "
                       << static_cast<double>(found.counters.noise_evaluations) / count << " with normals (bound 220), "
                       << 100.0 * (1.0 - static_cast<double>(x.size()) / count) << " % sky");
        CHECK(found.counters.noise_evaluations <= 220 * rays.size());
        CHECK(x.size() * 10 > rays.size() * 7);
    });
}

TEST_CASE("of every point that a ray looks at each octave is evaluated or left out for a reason") {
    Random random(81);
    std::uint64_t settled = 0, too_fine = 0;
    for (int i = 0; i < 16; ++i) {
        scene::Surface surface = random_surface(random);
        surface.kind = support::any_kind(static_cast<std::uint64_t>(i));
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        RayFamilies families(field, tracer, 1e-3);
        const Traced traced = trace_all(tracer, families.make(random, 200));
        const trace::TraceCounters& c = traced.counters;
        const std::uint64_t octaves = field.octaves().size();
        const std::uint64_t looked_up = c.noise_evaluations + c.left_out.total();
        CHECK(looked_up % octaves == 0);
        CHECK(looked_up >= c.steps * octaves);  // what float leaves in doubt is looked at twice
        CHECK(looked_up <= 2 * c.steps * octaves);
        CHECK(c.left_out.in_window == 0);
        settled += c.left_out.settled;
        too_fine += c.left_out.too_fine;
    }
    CHECK(settled > 0);
    CHECK(too_fine > settled);
}
