// Energy of light on and under level water.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "shaders_cpu/water_optics.h"
#include "tests/integrate/water_scenes.h"

using namespace strata;
using namespace strata::water_scenes;

TEST_CASE("white furnace: a white bed under water that takes nothing has the even sky's radiance, path by path") {
    for (const double wind : {0.0, 0.5, 8.0}) {
        for (const scene::SkyLight light : {scene::SkyLight::rays, scene::SkyLight::open}) {
            scene::Scene scene = basin(wind);
            make_furnace(scene, 0.7);
            scene.sky.light = light;
            CAPTURE(wind);
            for (const glm::vec3& c : evaluate(scene, Samples(32, 16)))
                REQUIRE(c.g == doctest::Approx(0.7).epsilon(1e-4));
        }
    }
}

TEST_CASE("a black bed leaves Fresnel's share of an even sky, straight down") {
    scene::Scene scene = basin(0.0);
    make_furnace(scene, 1.0);
    scene.material.low = scene.material.high = scene.material.steep = glm::dvec3(0.0);
    for (const glm::vec3& c : evaluate(scene, at_one_place(2, 4, 8.0, 8.0)))
        CHECK(c.g == doctest::Approx(shaders::fresnel(1.0)).epsilon(1e-5));
}

TEST_CASE("a white bed fades with its depth as Beer says, on the way down and on the way up") {
    scene::Scene scene = basin(0.0);
    make_furnace(scene, 1.0);
    scene.sky.light = scene::SkyLight::open;
    scene.water.absorption = {2.0, 0.7, 0.0};
    const glm::vec3 seen = evaluate(scene, at_one_place(1, 1, 8.0, 8.0)).front();
    for (const int c : {0, 1, 2}) {
        const double a = scene.water.absorption[c] * 0.5, kept = shaders::even_light_kept();
        const double down = (1.0 - kept) * std::exp(-1.2039 * a) / (1.0 - kept * std::exp(-2.0 * 1.2039 * a));
        const double f = shaders::fresnel(1.0);
        CHECK(seen[c] == doctest::Approx(f + (1.0 - f) * down * std::exp(-a)).epsilon(1e-4));
    }
}

// The sun straight over the eye, on a level bed.
TEST_CASE("sunlight on the bed is what comes in, leaves and comes back, and shade of the bed is seen") {
    scene::Scene scene = basin(0.0);
    scene.sky.light = scene::SkyLight::open;
    scene.sky.zenith = scene.sky.horizon = glm::dvec3(0.0);
    scene.sun = {.direction = {0.0, 1.0, 0.0}, .colour = glm::dvec3(1.0), .intensity = kPi};
    const double f = shaders::fresnel(1.0), kept = shaders::even_light_kept(), n2 = std::pow(shaders::kWaterIndex, 2.0);
    const double expected = (1.0 - f) * (1.0 - f) / n2 * 0.5 / (1.0 - 0.5 * kept);
    Counters counters;
    const glm::vec3 seen = evaluate(scene, at_one_place(1, 1, 8.0, 8.0), &counters).front();
    CHECK(seen.g == doctest::Approx(expected).epsilon(1e-4));
    CHECK(counters.water_rays == 2);
    CHECK(counters.shadow_rays == 2);  // under the face, and beyond
    scene.sun.direction = {1.0, 0.02, 0.0};
    scene.surface.octaves = 1;
    scene.surface.amplitude = 0.45;
    scene.surface.frequency = 3.0;
    const Places places(scene, 400);
    const std::vector<glm::vec3> rough = evaluate_all(scene, places.batch()).radiance;
    const auto dark = std::ranges::count_if(rough, [](const glm::vec3& c) { return c.g == 0.0f; });
    MESSAGE("in shade: ", dark);
    CHECK(dark > 10);
    CHECK(dark < 390);
}

// The eye under the mirror sees what the eye over it sees mirrored; its way up to the face is free of ground.
