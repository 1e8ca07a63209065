// The camera's geometry, by angles measured between rays.
#include "src/trace/camera.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::trace_test;

namespace {

constexpr double kPi = std::numbers::pi;

struct View {
    scene::Camera camera;
    scene::Film film;
};

View random_view(Random& random) {
    View view;
    view.film.width = 1 + static_cast<int>(random() % 2000);
    view.film.height = 1 + static_cast<int>(random() % 2000);
    view.camera.position = log_uniform(random, 1e-3, 1e7) * unit_vector(random);
    view.camera.look_at = view.camera.position + log_uniform(random, 1.0, 1e3) * unit_vector(random);
    view.camera.up = log_uniform(random, 1e-10, 1e10) * unit_vector(random);
    view.camera.fov_deg = uniform(random, 1.0, 170.0);
    return view;
}

glm::dvec3 forward_of(const scene::Camera& camera) { return glm::normalize(camera.look_at - camera.position); }

// Accurate for small and large angles alike.
double angle(const glm::dvec3& a, const glm::dvec3& b) {
    return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

}  // namespace

TEST_CASE("rays are of unit length, start at the position, and the frame's centre looks straight ahead") {
    Random random(21);
    for (int trial = 0; trial < 2000; ++trial) {
        const View view = random_view(random);
        const trace::Camera camera(view.camera, view.film);
        CHECK(camera.position() == view.camera.position);
        const glm::dvec3 ahead = camera.ray(0.5 * view.film.width, 0.5 * view.film.height).direction;
        CHECK(glm::distance(ahead, forward_of(view.camera)) < 1e-15 * 8.0);
        for (int i = 0; i < 5; ++i) {
            const double u = uniform(random, -10, view.film.width + 10),
                         v = uniform(random, -10, view.film.height + 10);
            CHECK(std::abs(glm::length(camera.ray(u, v).direction) - 1.0) < 1e-15);
        }
    }
}

TEST_CASE("the pixel centre in the middle of an odd frame looks straight ahead") {
    const trace::Camera camera(scene::Camera{}, {.width = 33, .height = 17});
    CHECK(camera.ray(16.5, 8.5).direction == glm::dvec3(0.0, 0.0, 1.0));
}

TEST_CASE("the angle between the middle of the left and right edges is fov_deg, from 0.01 to 179") {
    Random random(22);
    for (int trial = 0; trial < 2000; ++trial) {
        View view = random_view(random);
        view.camera.fov_deg = trial % 2 == 0 ? log_uniform(random, 0.01, 1.0) : uniform(random, 1.0, 179.0);
        const trace::Camera camera(view.camera, view.film);
        const double middle = 0.5 * view.film.height;
        const double fov = angle(camera.ray(0, middle).direction, camera.ray(view.film.width, middle).direction);
        CHECK(fov * 180.0 / kPi == doctest::Approx(view.camera.fov_deg).epsilon(1e-11));
        // Pixels are square: height only adds rows.
        const double tall = angle(camera.ray(0.5 * view.film.width, 0).direction,
                                  camera.ray(0.5 * view.film.width, view.film.height).direction);
        const double aspect = static_cast<double>(view.film.height) / view.film.width;
        CHECK(std::tan(0.5 * tall) == doctest::Approx(std::tan(0.5 * fov) * aspect).epsilon(1e-9));
    }
}

TEST_CASE("u goes right and v goes down in a right-handed world") {
    Random random(23);
    for (int trial = 0; trial < 2000; ++trial) {
        const View view = random_view(random);
        const trace::Camera camera(view.camera, view.film);
        const double u = 0.5 * view.film.width, v = 0.5 * view.film.height;
        const glm::dvec3 ahead = forward_of(view.camera), up = glm::normalize(view.camera.up);
        if (glm::length(glm::cross(ahead, up)) < 1e-3) continue;
        const glm::dvec3 rightwards = camera.ray(u + 0.25, v).direction - camera.ray(u - 0.25, v).direction;
        const glm::dvec3 downwards = camera.ray(u, v + 0.25).direction - camera.ray(u, v - 0.25).direction;
        CHECK(glm::dot(downwards, up) < 0.0);
        CHECK(std::abs(glm::dot(rightwards, up)) < 1e-10 * glm::length(rightwards));
        // Right, up and backwards are a right-handed frame.
        CHECK(glm::dot(glm::cross(rightwards, -downwards), -ahead) > 0.0);
    }
    // Facing +z with +y up, right is -x.
    const trace::Camera camera(scene::Camera{}, {.width = 64, .height = 64});
    CHECK(camera.ray(64, 32).direction.x < 0.0);
    CHECK(camera.ray(32, 0).direction.y > 0.0);
}

TEST_CASE("a turned camera's rays and position are the camera's own in the other axes") {
    Random random(25);
    double worst = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
        const View view = random_view(random);
        const trace::Camera camera(view.camera, view.film);
        const glm::dvec3 x = unit_vector(random), z = glm::normalize(glm::cross(x, unit_vector(random)));
        const glm::dmat3 axes(x, glm::cross(z, x), z);
        const trace::Camera turned = camera.turned(axes);
        const double u = uniform(random, 0, view.film.width), v = uniform(random, 0, view.film.height);
        const trace::CameraRay ray = camera.ray(u, v), other = turned.ray(u, v);
        CHECK(other.pixel_angle == doctest::Approx(ray.pixel_angle).epsilon(1e-12));
        for (int a = 0; a < 3; ++a) {
            worst = std::max(worst, std::abs(other.direction[a] - glm::dot(ray.direction, axes[a])));
            CHECK(std::abs(turned.position()[a] - glm::dot(camera.position(), axes[a])) <=
                  1e-15 * glm::length(camera.position()));
        }
    }
    CHECK(worst < 4e-15);
    MESSAGE("directions off, observed / bound: ", worst / 4e-15);
}

TEST_CASE("looking straight along up, or nearly so, gives finite rays of the right angles") {
    Random random(24);
    for (int trial = 0; trial < 300; ++trial) {
        View view = random_view(random);
        const glm::dvec3 axes[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, unit_vector(random)};
        const glm::dvec3 axis = axes[trial % 4];
        view.camera.up = axis;
        view.camera.position = glm::dvec3(1.0, 2.0, -3.0);
        const double tilt = trial % 3 == 0 ? 0.0 : log_uniform(random, 1e-16, 1e-3);
        const double side = random() % 2 == 0 ? 1.0 : -1.0;
        view.camera.look_at = view.camera.position + side * axis + tilt * unit_vector(random);
        view.camera.fov_deg = 60.0;
        const trace::Camera camera(view.camera, view.film);
        const double u = 0.5 * view.film.width, v = 0.5 * view.film.height;
        const glm::dvec3 right = glm::normalize(camera.ray(u + 1, v).direction - camera.ray(u - 1, v).direction);
        const glm::dvec3 down = glm::normalize(camera.ray(u, v + 1).direction - camera.ray(u, v - 1).direction);
        CHECK(std::abs(glm::dot(right, down)) < 1e-12);
        CHECK(std::abs(glm::dot(right, camera.ray(u, v).direction)) < 1e-12);
        CHECK(glm::dot(glm::cross(right, down), camera.ray(u, v).direction) == doctest::Approx(1.0));
    }
}

TEST_CASE("pixel_angle is the least angular width of a small pixel, across the frame, for fov 0.01 to 179") {
    Random random(25);
    double least = 1e300, most_of_whole = 0.0;
    for (int trial = 0; trial < 4000; ++trial) {
        View view = random_view(random);
        view.camera.fov_deg = trial % 2 == 0 ? log_uniform(random, 0.01, 1.0) : uniform(random, 1.0, 179.0);
        const trace::Camera camera(view.camera, view.film);
        const double u = uniform(random, 0, view.film.width), v = uniform(random, 0, view.film.height);
        const trace::CameraRay ray = camera.ray(u, v);
        // Symmetric differences over a step across which the angle is straight to 1e-7: tan grows by less than 1e-3.
        const double pixel = 2.0 * std::tan(view.camera.fov_deg * kPi / 360.0) / view.film.width;
        const double h = std::min(0.25, 1e-3 / pixel);
        double narrowest = 1e300;
        const double radial = std::atan2(v - 0.5 * view.film.height, u - 0.5 * view.film.width);
        for (int i = 0; i < 16; ++i) {
            const double turn = radial + i * kPi / 16.0, du = h * std::cos(turn), dv = h * std::sin(turn);
            const double width = angle(camera.ray(u + du, v + dv).direction, camera.ray(u - du, v - dv).direction);
            narrowest = std::min(narrowest, width / (2.0 * h));
        }
        least = std::min(least, narrowest / ray.pixel_angle);
        const double whole = angle(camera.ray(u - 0.5, v).direction, camera.ray(u + 0.5, v).direction);
        if (view.film.width >= 16) most_of_whole = std::max(most_of_whole, ray.pixel_angle / whole);
        CHECK(narrowest == doctest::Approx(ray.pixel_angle).epsilon(1e-5));
    }
    MESSAGE("narrowest width found " << least << " of pixel_angle; pixel_angle at most " << most_of_whole
                                     << " of a whole pixel's angle (frames 16 pixels wide and more)");
    CHECK(least > 1.0 - 1e-6);
}

TEST_CASE("a cone holds the rays through its square and, where the view is narrow, is hardly wider") {
    Random random(27);
    int wide = 0, cones = 0;
    double worst = -1.0, loosest = 0.0;
    for (int trial = 0; trial < 6000; ++trial) {
        const View view = random_view(random);
        const trace::Camera camera(view.camera, view.film);
        const double side = std::exp2(uniform(random, -6.0, 8.0));
        const double u = uniform(random, -0.1, 1.1) * view.film.width,
                     v = uniform(random, -0.1, 1.1) * view.film.height;
        const trace::CameraCone cone = camera.cone(u, v, side);
        if (!(cone.tangent < 1e3)) {
            ++wide;
            continue;
        }
        ++cones;
        REQUIRE(std::abs(glm::length(cone.direction) - 1.0) < 1e-15);
        double most = 0.0;
        for (int i = 0; i < 24; ++i) {
            const double across = i < 4 ? i & 1 : uniform(random, 0.0, 1.0);
            const double down = i < 4 ? i >> 1 : uniform(random, 0.0, 1.0);
            const glm::dvec3 d = camera.ray(u + across * side, v + down * side).direction;
            const double cosine = glm::dot(d, cone.direction);
            REQUIRE(cosine > 0.0);
            most = std::max(most, glm::length(glm::cross(d, cone.direction)) / cosine);
        }
        worst = std::max(worst, most - cone.tangent);
        // The tangent of the angle to the edge of a frame that is seen at up to 30 degrees: the square is
        // foreshortened.
        if (cone.tangent < 0.05 && glm::dot(cone.direction, forward_of(view.camera)) > std::cos(kPi / 6.0)) {
            loosest = std::max(loosest, cone.tangent / most);
        }
    }
    MESSAGE(cones << " cones, " << wide << " too wide; up to " << loosest << " of the angle that is needed");
    CHECK(worst <= 1e-15);
    CHECK(cones > 5000);
    CHECK(loosest < 1.3);
}
