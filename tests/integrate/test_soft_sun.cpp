// Directions by density, and a sun that is a disc: it gives the light of the hard one, and the mean of many in its
// penumbra.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "src/integrate/directions.h"
#include "tests/integrate/light_samples.h"

using namespace strata;
using namespace strata::light_samples;

TEST_CASE("directions: a frame is orthonormal, densities are as they say") {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 2000; ++i) {
        glm::dvec3 z = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        if (i == 0) z = {0.0, 0.0, -1.0};
        if (i == 1) z = {1e-9, 0.0, -1.0};
        const glm::dmat3 off = glm::transpose(frame_around(z)) * frame_around(z) - glm::dmat3(1.0);
        for (int c = 0; c < 3; ++c) CHECK(glm::length(off[c]) < 1e-9);
        CHECK(glm::determinant(frame_around(z)) == doctest::Approx(1.0));
    }
    // Of cosine / pi, the cosine's mean is 2/3 and its square's 1/2; of an even cap, its mean is (1 + cos a) / 2.
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.2, -0.9));
    constexpr int kCount = 200000;
    double first = 0.0, second = 0.0;
    glm::dvec3 centre(0.0);
    for (const double radius : {1e-7, 0.004653, 0.7, 1.5}) {
        double cap = 0.0;
        for (int i = 0; i < kCount; ++i) {
            const glm::dvec3 d = disc_direction(axis, radius, unit(random), unit(random));
            const double less = 2.0 * std::pow(std::asin(0.5 * glm::length(d - axis)), 2.0);  // about 1 - cosine
            REQUIRE(std::abs(glm::length(d) - 1.0) < 1e-14);
            REQUIRE(glm::length(d - axis) <= 2.0 * std::sin(0.5 * radius) * (1.0 + 1e-6));
            cap += less;
        }
        // 1 - cosine is even in [0, 1 - cos a]; angle^2 / 2 is close to it for small discs only.
        if (radius < 0.1) CHECK(cap / kCount == doctest::Approx(0.25 * radius * radius).epsilon(0.01));
    }
    for (int i = 0; i < kCount; ++i) {
        const glm::dvec3 d = cosine_direction(axis, unit(random), unit(random));
        const double cosine = glm::dot(d, axis);
        REQUIRE(cosine >= -1e-12);
        first += cosine;
        second += cosine * cosine;
        centre += d;
    }
    CHECK(first / kCount == doctest::Approx(2.0 / 3.0).epsilon(0.004));
    CHECK(second / kCount == doctest::Approx(0.5).epsilon(0.006));
    CHECK(glm::length(centre / static_cast<double>(kCount) - axis * (2.0 / 3.0)) < 0.006);
}

TEST_CASE("a soft sun on level ground gives the light of the hard one, within 3 sigma, whatever its size") {
    scene::Scene scene = scene_from_above(0.0);
    scene.sun.intensity = 2.0;
    scene.sun.direction = {0.2, 1.0, 0.1};
    scene.sky.light = scene::SkyLight::open;
    scene.sky.zenith = scene.sky.horizon = glm::dvec3(0.0);
    const Samples samples = at_one_place(200, 16, 8.0, 8.0);
    const double hard = static_cast<double>(evaluate(scene, at_one_place(1, 1, 8.0, 8.0))[0].g);
    for (const double radius_deg : {1e-6, 0.2666, 5.0, 30.0}) {
        scene.sun.angular_radius_deg = radius_deg;
        const Mean mean = mean_of(evaluate(scene, samples), 16);
        CAPTURE(radius_deg);
        CHECK(std::abs(mean.value - hard) < 3.0 * mean.error + 2e-6);
    }
}

// At each place the soft sun's light is the mean of what hard suns all over its disc give.
TEST_CASE("penumbra: the light of a soft sun on rough ground is the mean over hard suns of its disc, within 4 sigma") {
    scene::Scene scene = scene_from_above(3.0);
    scene.sun.intensity = 2.0;
    scene.sun.direction = {1.0, 0.45, 0.3};
    scene.sky.light = scene::SkyLight::open;
    scene.sky.zenith = scene.sky.horizon = glm::dvec3(0.0);
    constexpr double kRadiusDeg = 8.0;
    constexpr int kPlaces = 24, kSuns = 400;
    const Samples places(kPlaces, 1);
    std::vector<double> expected(kPlaces, 0.0);
    const double radius = glm::radians(kRadiusDeg);
    for (int k = 0; k < kSuns; ++k) {
        scene::Scene hard = scene;  // a golden-angle spiral fills the disc evenly
        hard.sun.direction = disc_direction(glm::normalize(scene.sun.direction), radius, (k + 0.5) / kSuns,
                                            std::fmod(k * 0.6180339887498949, 1.0));
        const std::vector<glm::vec3> radiance = evaluate(hard, places);
        const double factor = 2.0 / (1.0 + std::cos(radius)) / kSuns;
        for (int p = 0; p < kPlaces; ++p)
            expected[static_cast<std::size_t>(p)] +=
                factor * static_cast<double>(radiance[static_cast<std::size_t>(p)].g);
    }
    scene.sun.angular_radius_deg = kRadiusDeg;
    int in_penumbra = 0;
    for (int p = 0; p < kPlaces; ++p) {
        const double place = 16.0 * (p + 0.5) / kPlaces;
        const std::vector<glm::vec3> radiance = evaluate(scene, at_one_place(40, 25, place, place));
        const Mean mean = mean_of(radiance, 25);
        bool dark = false, lit = false;
        for (const glm::vec3& c : radiance) (c.g > 0.0f ? lit : dark) = true;
        in_penumbra += dark && lit;
        CHECK(std::abs(mean.value - expected[static_cast<std::size_t>(p)]) < 4.0 * mean.error + 4.0 / kSuns * 0.3);
    }
    CHECK(in_penumbra > 2);
    MESSAGE("places in the penumbra: ", in_penumbra);
}
