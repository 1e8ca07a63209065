#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "shaders_cpu/media/all.h"
#include "shaders_cpu/sky.h"

using namespace strata;
using namespace strata::shaders;

namespace {

glm::dvec3 direction_at(double elevation, double azimuth) {
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
}

double largest_difference(const glm::vec3& a, const glm::vec3& b) {
    const glm::dvec3 d = glm::abs(glm::dvec3(a) - glm::dvec3(b));
    return std::max({d.x, d.y, d.z});
}

bool between(const glm::vec3& value, const glm::dvec3& a, const glm::dvec3& b) {
    constexpr double kRounding = 1e-6;
    for (int c = 0; c < 3; ++c) {
        if (value[c] < std::min(a[c], b[c]) - kRounding || value[c] > std::max(a[c], b[c]) + kRounding) return false;
    }
    return true;
}

glm::vec3 apply_haze(const scene::Sky& sky, const glm::vec3& radiance, double distance, const glm::dvec3& direction) {
    scene::Scene scene;
    scene.sky = sky;
    return Haze({scene, nullptr}).along({glm::dvec3(0.0), direction, distance}).over(radiance);
}

}  // namespace

TEST_CASE("the sky is the zenith's colour straight up and the horizon's level and below") {
    const scene::Sky sky;
    CHECK(sky_radiance(sky, {0, 1, 0}) == glm::vec3(sky.zenith));
    CHECK(sky_radiance(sky, {1, 0, 0}) == glm::vec3(sky.horizon));
    CHECK(sky_radiance(sky, direction_at(-0.4, 2.0)) == glm::vec3(sky.horizon));
    CHECK(sky_radiance(sky, {0, -1, 0}) == glm::vec3(sky.horizon));
}

TEST_CASE("the sky falls monotonically from horizon to zenith, continuous in value and slope") {
    constexpr int kSteps = 20000;
    constexpr double kStep = 2.0 / kSteps;
    // Over y in [0,1] the weight (1 - y^2)^8 has |w'| <= 2.55 and |w''| <= 16 (both by its derivatives; w'' is -16 at
    // 0).
    double previous_slope = 0.0;
    double steepest = 0.0;
    double sharpest = 0.0;
    bool monotone = true;
    for (int i = 0; i < kSteps; ++i) {
        const double y = -1.0 + i * kStep;
        const double slope = (horizon_weight(y + kStep) - horizon_weight(y)) / kStep;
        monotone = monotone && slope <= 1e-9;
        steepest = std::max(steepest, std::fabs(slope));
        if (i > 0) sharpest = std::max(sharpest, std::fabs(slope - previous_slope) / kStep);
        previous_slope = slope;
    }
    CHECK(monotone);
    CHECK(steepest <= 2.55);
    CHECK(sharpest <= 16.01);
    MESSAGE("slope / bound: ", steepest / 2.55, ", bend / bound: ", sharpest / 16.01);
}

TEST_CASE("light on level ground is the cosine-weighted mean of the sky, by quadrature") {
    scene::Sky sky;
    sky.zenith = {0.1, 0.9, 3.0};
    sky.horizon = {2.0, 0.3, 0.0};
    glm::dvec3 sum(0.0);
    constexpr int kSteps = 2000;
    for (int i = 0; i < kSteps; ++i) {
        const double elevation = (i + 0.5) / kSteps * std::numbers::pi / 2;
        // cos to the pole * solid angle of the ring / pi
        const double weight = 2.0 * std::sin(elevation) * std::cos(elevation) * (std::numbers::pi / 2 / kSteps);
        sum += glm::dvec3(sky_radiance(sky, direction_at(elevation, 0.3))) * weight;
    }
    CHECK(largest_difference(glm::vec3(sum), ambient_light(sky, 1.0)) < 2e-6);
}

TEST_CASE("ambient light falls from sky to ground and has limits beyond a unit cosine") {
    const scene::Sky sky;
    double previous = 1e9;
    for (double up = 1.0; up >= -1.0; up -= 0.01) {
        const double light = ambient_light(sky, up).g;
        CHECK(light < previous);
        CHECK(light > 0.0);
        previous = light;
    }
    CHECK(ambient_light(sky, 1.0 + 1e-9) == ambient_light(sky, 1.0));
    CHECK(ambient_light(sky, -7.0) == ambient_light(sky, -1.0));
}

TEST_CASE("haze is in scenes of the gradient sky with a distance, and in no others") {
    scene::Scene scene;
    CHECK(members_in<Medium>({scene, nullptr}).empty());
    scene.sky.haze_distance = 60.0;
    CHECK(members_in<Medium>({scene, nullptr}).size() == 1);
    CHECK(Haze::is_in(scene));
    scene.sky.model = scene::SkyModel::daylight;
    CHECK(!Haze::is_in(scene));
}

TEST_CASE("haze does nothing when near, becomes the sky far away and lies between") {
    scene::Sky sky;
    const glm::vec3 radiance(0.9f, 0.05f, 0.4f);
    const glm::dvec3 direction = direction_at(-0.1, 1.0);
    sky.haze_distance = 60.0;
    CHECK(apply_haze(sky, radiance, 0.0, direction) == radiance);
    CHECK(apply_haze(sky, radiance, -1.0, direction) == radiance);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double far : {1e5, 1e300, infinity}) {
        CHECK(apply_haze(sky, radiance, far, direction) == sky_radiance(sky, direction));
        CHECK(apply_haze(sky, radiance, far, {0, 1, 0}) == glm::vec3(sky.zenith));
    }
    const glm::vec3 once = apply_haze(sky, radiance, 60.0, direction);
    const double e = std::numbers::e;
    CHECK(largest_difference(once, glm::vec3(glm::dvec3(radiance) / e + sky.horizon * (1.0 - 1.0 / e))) < 1e-6);
}

TEST_CASE("two stretches of haze, one after the other, are one of their sum") {
    scene::Sky sky;
    sky.haze_distance = 13.0;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit;
    double worst = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 radiance(unit(random), unit(random), unit(random));
        const glm::dvec3 direction = direction_at(unit(random) - 0.5, 6.0 * unit(random));
        const double near = 40.0 * unit(random);
        const double far = 40.0 * unit(random);
        const glm::vec3 steps = apply_haze(sky, apply_haze(sky, radiance, far, direction), near, direction);
        worst = std::max(worst, largest_difference(steps, apply_haze(sky, radiance, near + far, direction)));
    }
    CHECK(worst < 1e-6);
    MESSAGE("worst difference / bound: ", worst / 1e-6);
}

TEST_CASE("sky and haze stay finite and within their colours for extreme inputs") {
    scene::Sky sky;
    sky.zenith = {0.0, 1e6, 1e-30};
    sky.horizon = {1e6, 0.0, 0.0};
    for (const double haze : {1e-300, 1e-9, 1.0, 1e12})
        for (const double distance : {0.0, 1e-300, 1.0, 1e300, std::numeric_limits<double>::infinity()})
            for (const double y : {-1.0, -1e-300, 0.0, 1e-300, 0.5, 1.0, 1.0 + 1e-15}) {
                sky.haze_distance = haze;
                const glm::dvec3 direction(std::sqrt(std::max(0.0, 1.0 - y * y)), y, 0.0);
                CHECK(between(sky_radiance(sky, direction), sky.zenith, sky.horizon));
                const glm::vec3 hazed = apply_haze(sky, glm::vec3(0.5f), distance, direction);
                for (int c = 0; c < 3; ++c) CHECK(std::isfinite(hazed[c]));
                CHECK(between(hazed, glm::dvec3(0.5), glm::dvec3(sky_radiance(sky, direction))));
            }
}
