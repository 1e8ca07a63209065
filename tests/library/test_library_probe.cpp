#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "src/strata.h"
#include "tests/library/errors.h"

using strata::Probe;
using strata::Scene;
using strata::Vector;

namespace {

double length(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("rays of the screen hit within the tolerance of f = 0, where they say, and end outside of the surface") {
    for (const char* name : {"terrain", "hyperterrain", "planet", "isosurface"}) {
        Scene scene = Scene::builtin(name);
        scene.set("surface.scale", 0.9);
        const Probe probe(scene);
        int hits = 0;
        for (int y = 20; y < scene.height(); y += 90) {
            for (int x = 20; x < scene.width(); x += 160) {
                const strata::RayResult ray = probe.screen_ray(x, y);
                CHECK(length(ray.direction) == doctest::Approx(1.0));
                if (ray.outcome != strata::Outcome::hit) continue;
                ++hits;
                for (std::size_t a = 0; a < 3; ++a) {
                    CHECK(ray.position[a] == doctest::Approx(ray.origin[a] + ray.distance * ray.direction[a]));
                }
                CHECK(length(ray.normal) == doctest::Approx(1.0));
                // A tenth of a pixel at that distance, times a slope of 40 at most.
                const double pixel = ray.distance * 2.0 / scene.width();
                const strata::FieldValue field = probe.field(ray.position);
                if (std::string(name) != "isosurface") CHECK(std::abs(field.f) < 40 * 0.1 * pixel);
            }
        }
        CHECK(hits > 3);
    }
}

TEST_CASE("the gradient of f is that of its differences, by world position") {
    Scene scene = Scene::builtin("planet");
    scene.set("surface.scale", 3.0);
    scene.set("surface.rotation_deg", {20.0, 30.0, 40.0});
    const Probe probe(scene);
    const Vector at = {31.0, 5.0, -3.0};
    const Vector gradient = probe.field(at).gradient;
    for (std::size_t a = 0; a < 3; ++a) {
        constexpr double kStep = 1e-5;
        Vector before = at, after = at;
        before[a] -= kStep;
        after[a] += kStep;
        CHECK(gradient[a] ==
              doctest::Approx((probe.field(after).f - probe.field(before).f) / (2 * kStep)).epsilon(1e-4));
    }
}

TEST_CASE("a ray's length does not matter, and a moving surface is seen at its time") {
    Scene scene = Scene::builtin("planet");
    scene.set("surface.spin_deg_per_s", 90);
    const Probe probe(scene);
    const auto seen = [&](double length, double time) {
        return probe.ray({0, 0, 100}, {0, 0.01 * length, -length}, time).distance;
    };
    CHECK(seen(1.0, 0.0) > 0.0);
    CHECK(seen(0x1p1000, 0.0) == seen(1.0, 0.0));
    CHECK(seen(0x1p-1000, 0.0) == seen(1.0, 0.0));
    CHECK(seen(1.0, 0.5) != seen(1.0, 0.0));
    CHECK(seen(1.0, 4.0) == doctest::Approx(seen(1.0, 0.0)));
}

TEST_CASE("points and rays that make no sense are refused by name") {
    const Probe probe(Scene::builtin("terrain"));
    check_says(message_of([&] { probe.field({kNaN, 0, 0}); }), "position: not finite");
    check_says(message_of([&] { probe.field({1e30, 0, 0}); }), "position: ");
    check_says(message_of([&] { probe.field({0, 0, 0}, kNaN); }), "time: not finite");
    check_says(message_of([&] { probe.ray({0, 0, 0}, {0, 0, 0}); }), "direction: zero");
    check_says(message_of([&] { probe.ray({0, 0, 0}, {0, INFINITY, 0}); }), "direction: not finite");
    check_says(message_of([&] { probe.ray({0, 1e30, 0}, {0, 1, 0}); }), "origin: ");
    check_says(message_of([&] { probe.screen_ray(-1, 0); }), "u, v: out of the frame (-1, 0)");
    check_says(message_of([&] { probe.screen_ray(0, kNaN); }), "u, v: out of the frame");
    check_says(message_of([] { Probe of_edge(Scene::builtin("edge")); }), "image: this scene has no surface");
    Scene turning = Scene::builtin("terrain");
    turning.set("surface.spin_deg_per_s", 90);
    check_says(message_of([&] { Probe(turning).field({0, 0, 0}, 1e308); }), "time: ");
}
