// What clouds hide of the sun, and where they are in the wind.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/shaders/cloudy_sky.h"

using namespace strata;
using namespace strata::cloudy_sky;
using shaders::MediumRay;

TEST_CASE("the shadow of clouds lies where the line to the sun meets the layer") {
    scene::Scene scene = cloudy();
    scene.clouds.front().depth = 1.5;  // neither nothing nor all is hidden
    const Sky sky(scene);
    const shaders::CloudField field(scene.clouds.front());
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> unit;
    double least = 1.0, most = 0.0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 x{200.0 * unit(random), 20.0 * unit(random), -150.0 * unit(random)};
        const glm::dvec3 to_sun = at_elevation(3.0 + 80.0 * unit(random), 6.0 * unit(random));
        // The height over a level that falls by (distance across)^2 / 2R: march to the layer and bisect.
        const double across = std::hypot(to_sun.x, to_sun.z), radius = 6371e3 + scene.sky.altitude_m;
        const auto below = [&](double s) {
            return x.y * 100.0 + to_sun.y * s + s * s * across * across / (2.0 * radius) < 2600.0;
        };
        double low = 0.0, high = 1.0;
        while (below(high)) high *= 2.0;
        for (int step = 0; step < 80; ++step) (below(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
        const glm::dvec2 place = 100.0 * glm::dvec2(x.x, x.z) + low * glm::dvec2(to_sun.x, to_sun.z);
        const double climb = to_sun.y + low * across * across / radius;
        const double expected = std::exp(-field.depth_at(place) / std::max(climb, 0.1));
        const double found = sky.clouds.sunlight(x, to_sun);
        CHECK(found == doctest::Approx(expected).epsilon(0.02));
        least = std::min(least, found);
        most = std::max(most, found);
    }
    CHECK(least < 0.3);
    CHECK(most == 1.0);
    // Nothing throws a shadow on what is over it.
    for (int i = 0; i < 50; ++i) CHECK(sky.clouds.sunlight({3.0 * i, 26.01, 1.0}, at_elevation(30.0, i)) == 1.0f);
}

TEST_CASE("in the wind clouds and their shadows are where they were before, moved by as much as the wind went") {
    scene::Scene scene = cloudy();
    scene.clouds.front().depth = 1.5;
    const Sky rests(scene);
    scene.clouds.front().wind_m_s = 20.0;
    scene.clouds.front().wind_deg = 30.0;
    const Sky drifts(scene);
    constexpr double kTime = 450.0;
    // 9 km, in units of 100 m.
    const glm::dvec3 way{90.0 * std::sqrt(0.75), 0.0, 90.0 * 0.5};
    std::mt19937_64 random(21);
    std::uniform_real_distribution<double> unit;
    int moved = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 x{200.0 * unit(random), 20.0 * unit(random), -150.0 * unit(random)};
        const glm::dvec3 to_sun = at_elevation(3.0 + 80.0 * unit(random), 6.0 * unit(random));
        const float before = rests.clouds.sunlight(x, to_sun);
        CHECK(drifts.clouds.sunlight(x, to_sun) == before);
        CHECK(drifts.clouds.sunlight(x + way, to_sun, kTime) == doctest::Approx(before).epsilon(1e-5));
        moved += std::abs(drifts.clouds.sunlight(x, to_sun, kTime) - before) > 0.01f ? 1 : 0;
        MediumRay ray{x, to_sun, kInfinity};
        const double hidden = rests.clouds.opacity(ray);
        ray.origin += way;
        ray.time = kTime;
        CHECK(drifts.clouds.opacity(ray) == doctest::Approx(hidden).epsilon(1e-5));
    }
    CHECK(moved > 50);
}

TEST_CASE("of a layer's shadow as much falls as its key says, and what is seen of the layer stays") {
    scene::Scene scene = cloudy();
    scene.clouds.front().depth = 1.5;
    const Sky whole(scene);
    scene.clouds.front().shadow = 0.25;
    const Sky part(scene);
    scene.clouds.front().shadow = 0.0;
    const Sky none(scene);
    float darkest = 1.0f;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 x{7.0 * i, 2.0, -3.0 * i}, to_sun = at_elevation(25.0, 0.1 * i);
        const float light = whole.clouds.sunlight(x, to_sun);
        CHECK(part.clouds.sunlight(x, to_sun) == doctest::Approx(1.0 - 0.25 * (1.0 - light)).epsilon(1e-6));
        CHECK(none.clouds.sunlight(x, to_sun) == 1.0f);
        CHECK(none.clouds.opacity({x, to_sun, kInfinity}) == whole.clouds.opacity({x, to_sun, kInfinity}));
        darkest = std::min(darkest, light);
    }
    CHECK(darkest < 0.5f);
}
