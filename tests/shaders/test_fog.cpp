#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "shaders_cpu/media/fog.h"

using namespace strata;
using shaders::MediumRay;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

scene::Scene foggy() {
    scene::Scene scene;
    scene.scale.metres = 100.0;
    scene.fog = {.visibility_m = 2000.0, .level_m = 120.0, .fall_m = 90.0};
    return scene;
}

glm::dvec3 direction_at(double elevation, double azimuth) {
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}

// Simpson's rule on the density itself.
double integrated(const scene::Scene& scene, const MediumRay& ray) {
    const int steps = 20'000;
    const double length = ray.distance * scene.scale.metres, h = length / steps;
    double sum = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const double y = ray.origin.y * scene.scale.metres + ray.direction.y * h * i;
        const double weight = i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        sum += weight * std::exp(-(y - scene.fog.level_m) / scene.fog.fall_m);
    }
    return sum * h / 3.0 * std::log(50.0) / scene.fog.visibility_m;
}

}  // namespace

TEST_CASE("even fog's depth is the integral of its density, along rays of all slopes") {
    const scene::Scene scene = foggy();
    const shaders::Fog fog({scene, nullptr});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit;
    double worst = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double elevation = (i % 4 == 0 ? 1e-6 : i % 4 == 1 ? 1e-2 : 1.5) * (unit(random) - 0.5);
        const MediumRay ray{
            {0.0, 12.0 * unit(random), 0.0}, direction_at(elevation, 6.0 * unit(random)), 20.0 * unit(random)};
        const double expected = integrated(scene, ray);
        worst = std::max(worst, std::abs(fog.depth(ray) - expected) / expected);
    }
    MESSAGE("worst relative difference " << worst);
    CHECK(worst < 2e-4);  // the visibility's constant has four digits
}

TEST_CASE("depths of a way's parts add up, even or lifted by a noise, where the parts end with a piece") {
    scene::Scene scene = foggy();
    const shaders::Fog fog({scene, nullptr});
    const glm::dvec3 eye{0.0, 5.0, 0.0}, direction = direction_at(-0.2, 0.3);
    const double whole = fog.depth({eye, direction, 20.0});
    const double parts = fog.depth({eye, direction, 7.0}) + fog.depth({eye + 7.0 * direction, direction, 13.0});
    CHECK(whole == doctest::Approx(parts).epsilon(1e-12));
}

TEST_CASE("places in the fog are drawn by what is scattered before them, up and down, in thin fog and thick") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit;
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i) {
        scene::Scene scene = foggy();
        scene.fog.shafts = true;
        scene.fog.visibility_m = std::pow(10.0, 1.0 + 4.0 * unit(random));
        const shaders::Fog fog({scene, nullptr});
        const double elevation = (i % 3 == 0 ? 1e-7 : 1.5) * (unit(random) - 0.5);
        const MediumRay ray{
            {0.0, 12.0 * unit(random), 0.0}, direction_at(elevation, 6.0 * unit(random)), 20.0 * unit(random)};
        const double u = unit(random), whole = -std::expm1(-fog.depth(ray));
        const shaders::Fog::Shaft shaft = fog.shaft(ray, u);
        CHECK(shaft.way >= 0.0);
        CHECK(shaft.way <= ray.distance * (1.0 + 1e-12));
        const double before = -std::expm1(-fog.depth({ray.origin, ray.direction, shaft.way}));
        worst = std::max(worst, std::abs(before - u * whole));
    }
    MESSAGE("worst share of the light that is scattered before, off by " << worst);
    CHECK(worst < 1e-9);
}

TEST_CASE("a noise lifts the fog by rise_m at the most, about") {
    scene::Scene scene = foggy();
    const shaders::Fog even({scene, nullptr});
    scene.fog.rise_m = 60.0;
    const shaders::Fog lifted({scene, nullptr});
    double least = 1e9, most = 0.0;
    for (int i = 0; i < 500; ++i) {
        const MediumRay ray{{0.37 * i, 9.0, 0.11 * i}, {0.0, -1.0, 0.0}, 8.0};
        const double ratio = lifted.depth(ray) / even.depth(ray);
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    MESSAGE("depth straight down, over that of even fog: " << least << " to " << most);
    CHECK(least > std::exp(-1.4 * 60.0 / 90.0));
    CHECK(most < std::exp(1.4 * 60.0 / 90.0));
    CHECK(least < 0.85);
    CHECK(most > 1.15);
}

TEST_CASE("thick fog hides all, thin fog hides nothing, and the rest is in between for extreme inputs") {
    for (const double visibility : {1e-3, 1.0, 1e7})
        for (const double fall : {0.01, 50.0, 1e5})
            for (const double rise : {0.0, 1e3})
                for (const double y : {-10.0, 0.0, 1e-9, 30.0, 1e6})
                    for (const double climb : {-1.0, -1e-12, 0.0, 1e-12, 0.3, 1.0})
                        for (const double distance : {0.0, 1e-12, 3.0, 1e9, kInfinity}) {
                            scene::Scene scene = foggy();
                            scene.fog.visibility_m = visibility;
                            scene.fog.fall_m = fall;
                            scene.fog.rise_m = rise;
                            const shaders::Fog fog({scene, nullptr});
                            const glm::dvec3 direction{std::sqrt(1.0 - climb * climb), climb, 0.0};
                            const auto seen = fog.along({{0.0, y, 0.0}, direction, distance});
                            CHECK(seen.transmittance.x >= 0.0f);
                            CHECK(seen.transmittance.x <= 1.0f);
                            CHECK(std::isfinite(seen.inscatter.y));
                            for (const double u : {0.0, 0.5, 1.0 - 0x1p-33}) {
                                const auto shaft = fog.shaft({{0.0, y, 0.0}, direction, distance}, u);
                                CHECK(shaft.way >= 0.0);
                                CHECK(shaft.way <= std::min(distance, 1000.0) * (1.0 + 1e-12));
                                CHECK(std::isfinite(shaft.sunlight.x));
                            }
                            if (distance == 0.0) CHECK(seen.transmittance.x == 1.0f);
                        }
}

TEST_CASE("fog before a sky as bright as itself does not show") {
    scene::Scene scene = foggy();
    scene.sun.intensity = 0.0;
    scene.sky.zenith = scene.sky.horizon = glm::dvec3(0.5);
    const shaders::Fog fog({scene, nullptr});
    // Half of what is about is the ground's light, a fifth of the sky's.
    const glm::vec3 about(0.5f * (0.5f + 0.1f));
    const auto seen = fog.along({{0.0, 1.0, 0.0}, direction_at(0.02, 1.0), 40.0});
    CHECK(seen.transmittance.x < 0.1f);
    CHECK(seen.over(about).x == doctest::Approx(0.3f).epsilon(1e-5));
}
