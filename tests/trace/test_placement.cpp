// Where a surface stands: rotations, spin, scale, and the way there and back.
#include "src/trace/placement.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::trace_test;

namespace {

scene::Surface random_place(Random& random) {
    scene::Surface surface;
    surface.origin = log_uniform(random, 1e-3, 1e6) * unit_vector(random);
    surface.rotation_deg = 360.0 * glm::dvec3(uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -2, 2));
    surface.scale = log_uniform(random, 1e-6, 1e6);
    surface.spin_axis = log_uniform(random, 1e-6, 1e6) * unit_vector(random);
    surface.spin_deg_per_s = random() % 3 == 0 ? 0.0 : uniform(random, -1000, 1000);
    return surface;
}

// The rotation by its effect on one axis at a time, from cosines and sines of degrees.
glm::dvec3 turned(glm::dvec3 x, const glm::dvec3& degrees) {
    const auto turn = [](double& a, double& b, double angle) {
        const double c = std::cos(angle * std::numbers::pi / 180.0), s = std::sin(angle * std::numbers::pi / 180.0);
        const double turned_a = c * a - s * b;
        b = s * a + c * b;
        a = turned_a;
    };
    turn(x.y, x.z, degrees.x);
    turn(x.z, x.x, degrees.y);
    turn(x.x, x.y, degrees.z);
    return x;
}

}  // namespace

TEST_CASE("to the surface's coordinates and back is the same point, and distances scale") {
    Random random(31);
    double worst = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
        const scene::Surface surface = random_place(random);
        const trace::Placement placement(surface);
        const glm::dmat3 orientation = placement.orientation(uniform(random, -10, 10));
        const glm::dvec3 a = surface.origin + surface.scale * unit_vector(random);
        const glm::dvec3 b = surface.origin + surface.scale * 3.0 * unit_vector(random);
        const glm::dvec3 local_a = placement.point_to_local(orientation, a);
        const glm::dvec3 local_b = placement.point_to_local(orientation, b);
        // Of the coordinates' own rounding: the origin's and the point's.
        const double ulp = 0x1p-52 * (glm::length(surface.origin) + 4.0 * surface.scale);
        worst = std::max(worst, glm::distance(placement.point_to_world(orientation, local_a), a) / ulp);
        CHECK(placement.scale() == surface.scale);
        CHECK(std::abs(glm::distance(local_a, local_b) * surface.scale - glm::distance(a, b)) <= 16.0 * ulp);
        CHECK(placement.moves() == (surface.spin_deg_per_s != 0.0));
    }
    MESSAGE("round trip off by " << worst << " ulp (bound 16)");
    CHECK(worst <= 16.0);
}

TEST_CASE("a ray turned into the surface's coordinates passes through the same points") {
    Random random(32);
    for (int trial = 0; trial < 1000; ++trial) {
        const scene::Surface surface = random_place(random);
        const trace::Placement placement(surface);
        const glm::dmat3 orientation = placement.orientation(uniform(random, -10, 10));
        const trace::Ray world{.origin = surface.origin + 5.0 * surface.scale * unit_vector(random),
                               .direction = unit_vector(random),
                               .limit = 7.0 * surface.scale,
                               .delta0 = 1e-3 * surface.scale,
                               .delta_slope = 1e-4};
        const trace::Ray local = placement.to_local(orientation, world);
        CHECK(std::abs(glm::length(local.direction) - 1.0) < 1e-15);
        CHECK(local.limit * surface.scale == doctest::Approx(world.limit).epsilon(1e-15));
        CHECK(local.delta0 * surface.scale == doctest::Approx(world.delta0).epsilon(1e-15));
        CHECK(local.delta_slope == world.delta_slope);
        const double s = uniform(random, 0.0, local.limit);
        const glm::dvec3 expected = world.origin + s * surface.scale * world.direction;
        const glm::dvec3 found = placement.point_to_world(orientation, local.origin + s * local.direction);
        CHECK(glm::distance(found, expected) <= 0x1p-48 * (glm::length(surface.origin) + 12.0 * surface.scale));
    }
}

TEST_CASE("rotation_deg turns about x, then y, then z, right-handedly") {
    Random random(33);
    for (int trial = 0; trial < 1000; ++trial) {
        scene::Surface surface;
        surface.rotation_deg =
            glm::dvec3(uniform(random, -400, 400), uniform(random, -400, 400), uniform(random, -400, 400));
        const glm::dmat3 orientation = trace::Placement(surface).orientation(3.0);
        const glm::dvec3 x = unit_vector(random);
        CHECK(glm::distance(orientation * x, turned(x, surface.rotation_deg)) < 1e-14);
        CHECK(glm::determinant(orientation) == doctest::Approx(1.0).epsilon(1e-14));
        CHECK(glm::distance(trace::Placement::direction_to_local(orientation, orientation * x), x) < 1e-15 * 4.0);
    }
    scene::Surface surface;
    surface.rotation_deg = {90.0, 90.0, 0.0};
    // About x: z goes to -y; about y: -y stays.
    CHECK(trace::Placement(surface).orientation(0.0) * glm::dvec3(0, 0, 1) == glm::dvec3(0, -1, 0));
}

TEST_CASE("multiples of 90 degrees are exact: every entry is 0, 1 or -1") {
    Random random(34);
    const auto is_exact = [](const glm::dmat3& m) {
        for (int c = 0; c < 3; ++c) {
            for (int r = 0; r < 3; ++r) {
                if (m[c][r] != 0.0 && std::abs(m[c][r]) != 1.0) return false;
            }
        }
        return true;
    };
    int inexact = 0, wrong = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        scene::Surface surface;
        // Up to the largest angle that a scene may hold.
        const int turns = trial % 2 == 0 ? 8 : 11111;
        for (int a = 0; a < 3; ++a) {
            surface.rotation_deg[a] = 90.0 * (static_cast<int>(random() % (2 * turns + 1)) - turns);
        }
        const glm::dmat3 orientation = trace::Placement(surface).orientation(0.0);
        inexact += !is_exact(orientation);
        const glm::dvec3 x = unit_vector(random);
        wrong += glm::distance(orientation * x, turned(x, surface.rotation_deg)) > 1e-10;
    }
    CHECK(inexact == 0);
    CHECK(wrong == 0);
}

TEST_CASE("spin turns about its world axis after rotation_deg, and comes back after one period") {
    Random random(35);
    for (int trial = 0; trial < 1000; ++trial) {
        scene::Surface surface = random_place(random);
        surface.spin_deg_per_s = uniform(random, 1.0, 1000.0) * (random() % 2 == 0 ? 1.0 : -1.0);
        const trace::Placement placement(surface);
        const glm::dmat3 start = placement.orientation(0.0);
        const double t = uniform(random, -3, 3), period = 360.0 / surface.spin_deg_per_s;
        const glm::dvec3 x = unit_vector(random), axis = glm::normalize(surface.spin_axis);
        CHECK(glm::distance(start * x, turned(x, surface.rotation_deg)) < 1e-13);
        CHECK(glm::distance(placement.orientation(t + period) * x, placement.orientation(t) * x) < 1e-11);
        // The axis stays; what is across it turns by the angle, right-handedly.
        CHECK(glm::distance(placement.orientation(t) * (glm::transpose(start) * axis), axis) < 1e-14 * 4.0);
        const glm::dvec3 across = glm::normalize(glm::cross(axis, x));
        const glm::dvec3 moved = placement.orientation(t) * (glm::transpose(start) * across);
        const double angle = surface.spin_deg_per_s * t * std::numbers::pi / 180.0;
        CHECK(glm::dot(moved, across) == doctest::Approx(std::cos(angle)).epsilon(1e-10));
        CHECK(std::abs(glm::dot(moved, glm::cross(axis, across)) - std::sin(angle)) < 1e-10);
    }
}

TEST_CASE("a surface at rest has one orientation at all times, to the bit") {
    Random random(36);
    for (int trial = 0; trial < 100; ++trial) {
        scene::Surface surface = random_place(random);
        surface.spin_deg_per_s = 0.0;
        const trace::Placement placement(surface);
        CHECK(placement.orientation(0.0) == placement.orientation(uniform(random, -1e6, 1e6)));
        surface.spin_deg_per_s = 77.0;
        CHECK(trace::Placement(surface).orientation(0.0) == placement.orientation(0.0));
    }
}
