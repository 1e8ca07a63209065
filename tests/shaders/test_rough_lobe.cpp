// What rough surfaces do with light from one direction, against integrals over the hemisphere.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shaders_cpu/rough_lobe.h"

using namespace strata::shaders;

namespace {

const glm::dvec3 kUp(0.0, 1.0, 0.0);

glm::dvec3 direction(double cosine, double azimuth) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {sine * std::cos(azimuth), cosine, sine * std::sin(azimuth)};
}

// The cosine-weighted mean over directions of light, by the midpoint rule in (cosine^2, azimuth).
double reflected(const RoughLobe& lobe, const glm::dvec3& to_eye) {
    constexpr int kRings = 4000, kParts = 200;
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i) {
        for (int j = 0; j < kParts; ++j) {
            const double azimuth = (j + 0.5) / kParts * 2.0 * std::numbers::pi;
            sum += lobe(kUp, direction(std::sqrt((i + 0.5) / kRings), azimuth), to_eye);
        }
    }
    return sum / (kRings * kParts);
}

}  // namespace

TEST_CASE("a white rough surface under even light is white from every direction: the furnace") {
    double worst = 0.0;
    for (const double roughness : {0.05, 0.3, 0.7, 1.0}) {
        const RoughLobe lobe(roughness);
        for (const double cosine : {0.02, 0.1, 0.3, 0.6, 0.9, 1.0})
            worst = std::max(worst, std::abs(reflected(lobe, direction(cosine, 0.4)) - 1.0));
    }
    MESSAGE("farthest from 1: ", worst);
    CHECK(worst < 2e-4);  // of the midpoint rule, whose integrand has edges
}

TEST_CASE("roughness 0 is Lambert") {
    const RoughLobe lobe(0.0);
    for (const double in : {0.01, 0.5, 1.0}) {
        for (const double out : {0.01, 0.5, 1.0})
            CHECK(lobe(kUp, direction(in, 0.0), direction(out, 2.0)) == doctest::Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("light and eye may change places, and nothing is negative or without bound") {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    double least = 1e9, most = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        const RoughLobe lobe(u(random));
        const glm::dvec3 a = direction(1e-3 + u(random) * (1.0 - 1e-3), 7.0 * u(random));
        const glm::dvec3 b = direction(1e-3 + u(random) * (1.0 - 1e-3), 7.0 * u(random));
        const double value = lobe(kUp, a, b);
        REQUIRE(std::isfinite(value));
        REQUIRE(value == doctest::Approx(lobe(kUp, b, a)).epsilon(1e-12));
        least = std::min(least, value);
        most = std::max(most, value);
    }
    CHECK(least >= 0.0);
    MESSAGE("from ", least, " to ", most);
}

TEST_CASE("a full moon is flat: under light from behind the eye a rough slope is hardly darker than level ground") {
    const RoughLobe rough(1.0), even(0.0);
    const glm::dvec3 level = direction(1.0, 0.0), slanting = direction(0.3, 0.0);
    const auto radiance = [](const RoughLobe& lobe, const glm::dvec3& both) { return lobe(kUp, both, both) * both.y; };
    CHECK(radiance(even, slanting) / radiance(even, level) == doctest::Approx(0.3));
    CHECK(radiance(rough, slanting) / radiance(rough, level) > 0.55);
}

TEST_CASE("light from below the surface is none") {
    const RoughLobe lobe(0.5);
    CHECK(lobe(kUp, {0.6, -0.8, 0.0}, {0.0, 1.0, 0.0}) == 0.0);
    CHECK(lobe(kUp, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}) == 0.0);
}

TEST_CASE("a normal that is turned away from the eye shines on as it turns, and loses no light at once") {
    for (const double roughness : {0.01, 0.35, 1.0}) {
        const RoughLobe lobe(roughness);
        const glm::dvec3 to_light = direction(0.7, 1.0);
        double before = lobe(kUp, to_light, direction(0.05, 1.5));
        for (double cosine = 0.05; cosine > -0.9; cosine -= 0.001) {
            const glm::dvec3 to_eye = direction(cosine, 1.5);
            const double value = lobe(kUp, to_light, to_eye);
            CHECK(std::abs(value - before) < 0.01);
            CHECK(value > 0.3);
            before = value;
        }
    }
}
