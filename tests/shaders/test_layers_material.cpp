// Layers of ground against the formulas that their keys tell.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "noise/reference.h"
#include "shaders_cpu/materials/all.h"
#include "src/scene/toml_reader.h"

using namespace strata;
using namespace strata::shaders;

namespace {

struct RandomGround {
    std::mt19937_64 random;
    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }

    ShadingPoint point() {
        ShadingPoint point;
        point.x = {number(-50, 50), number(-2, 5), number(-50, 50)};
        point.height = point.x.y;
        point.normal = glm::normalize(glm::dvec3(number(-1, 1), number(-0.5, 1), number(-1, 1)));
        point.up_dot_normal = point.normal.y;
        return point;
    }

    scene::SoftRange range(double least, double most) {
        const double from = number(least, most);
        return {from, from + number(1e-3, most - least), number(1e-3, 0.3 * (most - least))};
    }

    // Every kind of mask at once.
    scene::GroundLayer layer() {
        scene::GroundLayer layer;
        layer.colour = {number(0, 1), number(0, 1), number(0, 1)};
        layer.second_colour = {number(0, 1), number(0, 1), number(0, 1)};
        layer.tone = number(0, 1);
        layer.roughness = number(0, 1);
        layer.cover = number(0.5, 1);
        layer.height = range(-3, 4);
        layer.height_noise = number(0, 1);
        layer.slope_deg = range(0, 120);
        layer.slope_noise_deg = number(0, 20);
        layer.aspect = {number(-1, 1), 0.1, number(-1, 1)};
        layer.facing = range(-1, 0.5);
        layer.patches = range(-2, 1);
        layer.noise.seed = random() % 100;
        layer.noise.stretch = number(0.2, 5);
        layer.beds = range(-2, 1);
        layer.strata.warp = number(0, 0.5);
        layer.strata.seed = random() % 100;
        return layer;
    }
};

// By the definition, sharing no code with the material.
double step(double x, double width) {
    const double t = std::min(std::max(x / width + 0.5, 0.0), 1.0);
    return 3.0 * t * t - 2.0 * t * t * t;
}

double share(const scene::SoftRange& range, double x) {
    return step(x - range.from, range.edge) * (1.0 - step(x - range.to, range.edge));
}

double unit_noise(const glm::dvec3& p, int octaves, double gain, std::uint64_t seed) {
    const auto all = noise::make_octaves({.octaves = octaves, .lacunarity = 2.0, .gain = gain, .seed = seed});
    double sum = 0.0, squares = 0.0;
    for (const noise::Octave& o : all) {
        sum += o.amplitude * noise::reference_value<3>(
                                 o.key, noise::split_position<3>(noise::octave_position<3>(o, {p.x, p.y, p.z})));
        squares += o.amplitude * o.amplitude;
    }
    return sum / std::sqrt(0.0729 * squares);
}

scene::Scene two_layers(const scene::GroundLayer& upper) {
    scene::Scene scene;
    scene.ground.resize(2);
    scene.ground[0].colour = glm::dvec3(0.25);
    scene.ground[1] = upper;
    return scene;
}

// With black below and white above, reflectance is the upper layer's mask.
double mask(scene::GroundLayer upper, const ShadingPoint& point) {
    upper.colour = glm::dvec3(1.0);
    upper.tone = 0.0;
    scene::Scene scene = two_layers(upper);
    scene.ground[0].colour = glm::dvec3(0.0);
    return LayersMaterial(scene).reflectance(point).g;
}

}  // namespace

TEST_CASE("a scene has layers if it has [[ground]], else the terrain's material") {
    const scene::Scene plain, layered = two_layers({});
    CHECK(std::holds_alternative<TerrainMaterial>(member_in<Material>({plain, nullptr})));
    CHECK(std::holds_alternative<LayersMaterial>(member_in<Material>({layered, nullptr})));
}

TEST_CASE("a mask is the product of its soft ranges, of points and their noises by definition") {
    RandomGround ground{std::mt19937_64(1)};
    double worst = 0.0, mean = 0.0;
    constexpr int kPoints = 20'000;
    for (int i = 0; i < kPoints; ++i) {
        scene::GroundLayer layer = ground.layer();
        // Steps of one range do not overlap here: then their product is their difference.
        for (scene::SoftRange* range : {&layer.height, &layer.slope_deg, &layer.facing, &layer.patches, &layer.beds})
            range->edge = std::min(range->edge, range->to - range->from);
        const ShadingPoint point = ground.point();
        const scene::GroundNoise& n = layer.noise;
        const double noise = unit_noise(point.x / n.size / glm::dvec3(1.0, n.stretch, 1.0), n.octaves, n.gain, n.seed);
        const scene::GroundStrata& s = layer.strata;
        const double warped = point.height + s.warp * unit_noise(point.x / s.warp_size, 3, 0.4, s.seed + 1);
        const double beds =
            unit_noise(point.x / s.length + glm::dvec3(0.0, warped / s.thickness, 0.0), s.octaves, s.gain, s.seed);
        const glm::dvec3 aspect = glm::normalize(layer.aspect);
        const double facing = point.normal.x * aspect.x + point.normal.z * aspect.z;
        const double slope = std::acos(point.normal.y) * 180.0 / std::numbers::pi;
        // Ends at the ends of what is allowed are none.
        if (layer.slope_deg.to >= 180.0) layer.slope_deg.to = 1e9;
        if (layer.facing.to >= 1.0) layer.facing.to = 1e9;
        const double expected = layer.cover * share(layer.height, point.height + layer.height_noise * noise) *
                                share(layer.slope_deg, slope + layer.slope_noise_deg * noise) *
                                share(layer.facing, facing) * share(layer.patches, noise) * share(layer.beds, beds);
        mean += expected / kPoints;
        worst = std::max(worst, std::abs(mask(layer, point) - expected));
    }
    MESSAGE("mean mask ", mean, ", farthest off ", worst);
    CHECK(mean > 0.005);
    // The arc cosine is 2e-6 degrees off, along a step as steep as 1.5 a thousandth of a degree.
    CHECK(worst < 3.1e-3);
}

TEST_CASE("layers are mixed: shares of colours are in [0,1] and sum to 1, whatever the masks") {
    RandomGround ground{std::mt19937_64(2)};
    double worst = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        scene::Scene scene;
        scene.ground = {ground.layer(), ground.layer(), ground.layer()};
        for (int l = 0; l < 3; ++l) {
            scene.ground[l].tone = 0.0;
            scene.ground[l].colour = glm::dvec3(0.0);
            scene.ground[l].colour[l] = 1.0;
        }
        ShadingPoint point = ground.point();
        point.footprint = i % 3 == 0 ? 0.0 : std::exp(ground.number(-12.0, 8.0));
        const glm::dvec3 shares(LayersMaterial(scene).reflectance(point));
        for (int c = 0; c < 3; ++c) {
            REQUIRE(shares[c] >= 0.0);
            REQUIRE(shares[c] <= 1.0);
        }
        worst = std::max(worst, std::abs(shares.x + shares.y + shares.z - 1.0));
    }
    CHECK(worst < 4e-7);  // three floats
}

TEST_CASE("reflectances of colours in [0,1] are in [0,1], with tones, roughness and extreme points") {
    RandomGround ground{std::mt19937_64(3)};
    for (int i = 0; i < 20'000; ++i) {
        scene::Scene scene = two_layers(ground.layer());
        scene.ground[0].tone = 1.0;
        ShadingPoint point = ground.point();
        if (i % 4 == 0) point.x *= 1e9;
        if (i % 5 == 0) point.height = 1e12;
        if (i % 7 == 0) point.up_dot_normal = 1.0 + 1e-12;
        point.footprint = i % 2 == 0 ? 0.0 : std::exp(ground.number(-30.0, 30.0));
        const SurfaceLook look = LayersMaterial(scene).look(point);
        for (int c = 0; c < 3; ++c) {
            REQUIRE(look.reflectance[c] >= 0.0f);
            REQUIRE(look.reflectance[c] <= 1.0f + 1e-6f);
        }
        REQUIRE(look.roughness >= 0.0);
        REQUIRE(look.roughness <= 1.0 + 1e-12);
    }
}

TEST_CASE("masks are continuous: of points that are ever nearer they differ ever less") {
    RandomGround ground{std::mt19937_64(4)};
    double worst = 0.0;
    for (int i = 0; i < 5'000; ++i) {
        scene::GroundLayer layer = ground.layer();
        for (scene::SoftRange* range : {&layer.height, &layer.facing, &layer.patches, &layer.beds}) range->edge = 0.1;
        layer.slope_deg.edge = 2.0;
        ShadingPoint point = ground.point();
        if (i % 2 == 0) point.normal = glm::normalize(glm::dvec3(1e-9, 1.0, 1e-9));  // level: no side that it faces
        point.up_dot_normal = point.normal.y;
        point.footprint = ground.number(0.0, 0.5);
        ShadingPoint other = point;
        constexpr double kNear = 1e-7;
        other.x += kNear;
        other.height += kNear;
        other.normal = glm::normalize(other.normal + kNear * glm::dvec3(-1.0, 0.3, 0.7));
        other.up_dot_normal = other.normal.y;
        other.footprint *= 1.0 + kNear;
        worst = std::max(worst, std::abs(mask(layer, point) - mask(layer, other)));
    }
    MESSAGE("largest difference over a distance of 1e-7: ", worst);
    // A step of 0.1 is at most 15 steep; noise of 2^7 cells a unit and amplitude 1 some 500; two degrees of slope 43
    // a radian, where the arc cosine near level ground is 1e-7's root steep.
    CHECK(worst < 5e-3);
}

TEST_CASE("tone mixes the second colour in by half where its noise is 0, and on the whole") {
    scene::Scene scene;
    scene.ground.resize(1);
    scene.ground[0].kind = scene::GroundKind::granite;
    scene.ground[0].tone = 0.8;
    scene.ground[0].second_colour = glm::dvec3(0.0);
    const LayersMaterial material(scene);
    RandomGround ground{std::mt19937_64(5)};
    for (const double footprint : {0.0, 0.1, 100.0}) {
        double mean = 0.0;
        for (int i = 0; i < 20'000; ++i) {
            ShadingPoint point = ground.point();
            point.footprint = footprint;
            mean += material.reflectance(point).g / 20'000;
        }
        CHECK(mean == doctest::Approx(0.28 * 0.6).epsilon(0.02));
    }
}

TEST_CASE("the ground flows with the noise of its surface") {
    const scene::Scene scene = scene::read_scene(R"([[ground]]
name = "rock"
[[ground]]
name = "patches"
kind = "fresh_snow"
noise_from = 0.0
)",
                                                 "here");
    const LayersMaterial material(scene);
    RandomGround ground{std::mt19937_64(6)};
    for (int i = 0; i < 100; ++i) {
        ShadingPoint point = ground.point(), shifted = point;
        shifted.x = {3.0, point.x.y, 0.5};
        shifted.noise_shift = point.x - shifted.x;
        CHECK(material.reflectance(point) == material.reflectance(shifted));
    }
}

TEST_CASE("of a planet, layers face along its ground, whichever way that lies") {
    scene::Scene scene = two_layers({});
    scene.ground[0].colour = glm::dvec3(0.0);
    scene.ground[1].colour = glm::dvec3(1.0);
    scene.ground[1].aspect = {0.0, 1.0, 0.0};
    scene.ground[1].facing = {0.3, 1.0, 0.1};
    const LayersMaterial material(scene);
    // At the equator a wall may face north; at the pole level ground does not, though its normal points that way.
    ShadingPoint wall{.x = {10.0, 0.0, 0.0}, .normal = {0.0, 1.0, 0.0}, .up_dot_normal = 0.0};
    wall.up = {1.0, 0.0, 0.0};
    ShadingPoint level{.x = {0.0, 10.0, 0.0}, .normal = {0.0, 1.0, 0.0}, .up_dot_normal = 1.0};
    level.up = {0.0, 1.0, 0.0};
    CHECK(material.reflectance(wall).g == 1.0f);
    CHECK(material.reflectance(level).g == 0.0f);
}
