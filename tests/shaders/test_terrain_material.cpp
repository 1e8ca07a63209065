#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "shaders_cpu/lights/all.h"
#include "shaders_cpu/materials/all.h"
#include "shaders_cpu/sky.h"

using namespace strata;
using namespace strata::shaders;

namespace {

double cos_deg(double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); }

bool close(const glm::vec3& a, const glm::vec3& b, double tolerance = 1e-6) {
    for (int c = 0; c < 3; ++c)
        if (std::fabs(static_cast<double>(a[c]) - b[c]) > tolerance) return false;
    return true;
}

glm::vec3 albedo(const scene::Material& material, double height, double slope_cosine) {
    return TerrainMaterial(material).albedo(height, slope_cosine);
}

struct LitPoint {
    double height, up_dot_normal, n_dot_sun;
    float sun_visibility;
};

// The sun overhead, the normal at n_dot_sun to it; "up" is another matter.
glm::vec3 shade(const scene::Material& material, const scene::Sun& sun, const scene::Sky& sky, const LitPoint& lit) {
    scene::Scene scene;
    scene.material = material;
    scene.sun = sun;
    scene.sky = sky;
    const double level = std::sqrt(std::max(0.0, 1.0 - lit.n_dot_sun * lit.n_dot_sun));
    const ShadingPoint point{.normal = {level, lit.n_dot_sun, 0.0},
                             .height = lit.height,
                             .up_dot_normal = lit.up_dot_normal,
                             .to_light = {0.0, 1.0, 0.0}};
    glm::vec3 light(0.0f);
    for (const Light& source : members_in<Light>({scene, nullptr})) {
        light += std::visit(
            [&](const auto& member) {
                return member.on_white(point) * (member.casts_shadows() ? lit.sun_visibility : 1.0f);
            },
            source);
    }
    return TerrainMaterial(material).reflectance(point) * light;
}

double luminance(const glm::vec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

}  // namespace

TEST_CASE("albedo is low, high and steep well inside their bands, and half-way at their middles") {
    const scene::Material material;
    const double gentle = cos_deg(10.0);
    CHECK(close(albedo(material, 0.0, gentle), glm::vec3(material.low)));
    CHECK(close(albedo(material, 0.5, gentle), glm::vec3(material.high)));
    CHECK(close(albedo(material, 0.25, gentle), glm::vec3(0.5 * (material.low + material.high))));
    for (const double cosine : {cos_deg(60.0), 0.0, -0.5, -1.0}) {
        CHECK(close(albedo(material, 0.0, cosine), glm::vec3(material.steep)));
        CHECK(close(albedo(material, 0.5, cosine), glm::vec3(material.steep)));
    }
    CHECK(close(albedo(material, 0.0, cos_deg(38.0)), glm::vec3(0.5 * (material.low + material.steep))));
    // The bands end where their widths say.
    CHECK(close(albedo(material, 0.1999, gentle), glm::vec3(material.low), 1e-5));
    CHECK(!close(albedo(material, 0.22, gentle), glm::vec3(material.low), 1e-2));
    CHECK(close(albedo(material, 0.0, cos_deg(32.0)), glm::vec3(material.low), 1e-5));
    CHECK(close(albedo(material, 0.0, cos_deg(44.0)), glm::vec3(material.steep), 1e-5));
    CHECK(!close(albedo(material, 0.0, cos_deg(41.0)), glm::vec3(material.steep), 1e-2));
}

TEST_CASE("albedo is what its definition gives in double, arc cosine and all, to 1e-6") {
    const scene::Material material;
    const auto blend = [](double x, double centre, double width) {
        const double s = std::clamp((x - centre) / width + 0.5, 0.0, 1.0);
        return s * s * (3.0 - 2.0 * s);
    };
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    double worst = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const double height = 0.25 + 0.1 * unit(random);
        const double cosine = i % 2 == 0 ? unit(random) : cos_deg(38.0 + 7.0 * unit(random));
        const double slope_deg = std::acos(cosine) * 180.0 / std::numbers::pi;
        const double steep = blend(slope_deg, material.steep_deg, material.steep_width_deg);
        const double high = blend(height, material.band_height, material.band_width);
        const glm::dvec3 expected =
            (material.low * (1.0 - high) + material.high * high) * (1.0 - steep) + material.steep * steep;
        const glm::dvec3 off = glm::abs(glm::dvec3(albedo(material, height, cosine)) - expected);
        worst = std::max({worst, off.r, off.g, off.b});
    }
    CHECK(worst <= 1e-6);
    MESSAGE("off, observed / bound: ", worst / 1e-6);
}

TEST_CASE("albedo is a convex mix of the three reflectances") {
    // With the axes as reflectances, the mix is its own weights.
    scene::Material material;
    material.low = {1, 0, 0};
    material.high = {0, 1, 0};
    material.steep = {0, 0, 1};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    double worst_sum = 0.0;
    bool inside = true;
    for (int i = 0; i < 100000; ++i) {
        material.band_height = unit(random);
        material.band_width = std::pow(10.0, 6.0 * unit(random));
        material.steep_deg = 45.0 + 45.0 * unit(random);
        material.steep_width_deg = std::pow(10.0, 2.5 * unit(random) - 0.5);
        const double height = unit(random) * std::pow(10.0, 3.0 * unit(random));
        const glm::vec3 weights = albedo(material, height, unit(random));
        for (int c = 0; c < 3; ++c) inside = inside && weights[c] >= 0.0f && weights[c] <= 1.0f;
        worst_sum = std::max(worst_sum, std::fabs(static_cast<double>(weights.r) + weights.g + weights.b - 1.0));
    }
    CHECK(inside);
    CHECK(worst_sum <= 2e-7);
    MESSAGE("sum of weights off 1, observed / bound: ", worst_sum / 2e-7);
}

TEST_CASE("albedo grows monotonically from low to high and from gentle to steep") {
    scene::Material material;
    material.low = glm::dvec3(0.0);
    material.high = glm::dvec3(0.5);
    material.steep = glm::dvec3(1.0);
    for (double previous = -1.0, height = -0.2; height < 0.6; height += 0.001) {
        const double value = albedo(material, height, 1.0).g;
        REQUIRE(value >= previous);
        previous = value;
    }
    for (double previous = -1.0, degrees = 0.0; degrees <= 180.0; degrees += 0.25) {
        const double value = albedo(material, 0.0, cos_deg(degrees)).g;
        REQUIRE(value >= previous);
        previous = value;
    }
}

TEST_CASE("sunlight is Lambert's: proportional to the cosine, to visibility, to intensity, over pi") {
    scene::Sun sun;
    scene::Sky dark;
    dark.zenith = dark.horizon = glm::dvec3(0.0);
    const scene::Material material;
    const LitPoint facing{0.0, 1.0, 1.0, 1.0f};
    const glm::vec3 full = shade(material, sun, dark, facing);
    CHECK(close(full, glm::vec3(material.low * sun.colour * sun.intensity / std::numbers::pi)));
    for (const double cosine : {0.0, 0.25, 0.5, 0.9}) {
        CHECK(close(shade(material, sun, dark, {0.0, 1.0, cosine, 1.0}), full * static_cast<float>(cosine)));
        CHECK(close(shade(material, sun, dark, {0.0, 1.0, 1.0, static_cast<float>(cosine)}),
                    full * static_cast<float>(cosine)));
    }
    CHECK(shade(material, sun, dark, {0.0, 1.0, -0.7, 1.0}) == glm::vec3(0.0f));
    sun.intensity *= 2.0;
    CHECK(close(shade(material, sun, dark, facing), full * 2.0f));
}

TEST_CASE("without a sun only the sky's light is left, whatever the sun's direction") {
    scene::Sun sun;
    sun.intensity = 0.0;
    const scene::Sky sky;
    const scene::Material material;
    for (const double cosine : {-1.0, 0.3, 1.0})
        CHECK(close(shade(material, sun, sky, {0.0, 1.0, cosine, 1.0}),
                    glm::vec3(material.low) * ambient_light(sky, 1.0)));
}

TEST_CASE("a shadow is darker than sunlight, not black, and keeps the relief: more light on the sun's side") {
    const scene::Sun sun;
    const scene::Sky sky;
    const scene::Material material;
    const double lit = luminance(shade(material, sun, sky, {0.0, 0.9, 0.7, 1.0}));
    const double shadow = luminance(shade(material, sun, sky, {0.0, 0.9, 0.7, 0.0}));
    const double away = luminance(shade(material, sun, sky, {0.0, 0.9, -0.7, 0.0}));
    CHECK(shadow < lit);
    CHECK(away < shadow);
    CHECK(away > 0.1 * lit);
}

TEST_CASE("the default materials under the default light are well exposed") {
    // Radiances between deep shadow and white at exposure 0: grass and rock around mid-grey, snow below clipping.
    const scene::Sun sun;
    const scene::Sky sky;
    const scene::Material material;
    const double grass = luminance(shade(material, sun, sky, {0.0, 1.0, 0.7, 1.0}));
    const double rock = luminance(shade(material, sun, sky, {0.0, 0.6, 0.9, 1.0}));
    const double snow = luminance(shade(material, sun, sky, {1.0, 1.0, 0.7, 1.0}));
    MESSAGE("grass ", grass, ", rock ", rock, ", snow ", snow);
    CHECK(grass > 0.09);
    CHECK(grass < 0.36);
    CHECK(rock > 0.09);
    CHECK(rock < 0.5);
    CHECK(snow > 0.5);
    CHECK(snow < 1.5);
}

TEST_CASE("shading is finite and not negative for extreme inputs") {
    scene::Material material;
    scene::Sun sun;
    const scene::Sky sky;
    for (const double width : {1e-300, 1e-9, 1.0, 1e9})
        for (const double height : {-1e300, -1.0, 0.0, 0.25, 1e300})
            for (const double cosine : {-1.0 - 1e-12, -1.0, 0.0, 1e-300, 1.0, 1.0 + 1e-12})
                for (const double intensity : {0.0, 1e6}) {
                    material.band_width = width;
                    material.steep_width_deg = width;
                    sun.intensity = intensity;
                    const glm::vec3 radiance = shade(material, sun, sky, {height, cosine, cosine, 1.0});
                    for (int c = 0; c < 3; ++c) CHECK((std::isfinite(radiance[c]) && radiance[c] >= 0.0f));
                }
}
