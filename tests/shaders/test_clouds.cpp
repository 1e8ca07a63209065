// Layers of clouds: how much of the sky they cover, where they stand, and what they send on.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shaders_cpu/cloud_crossing.h"
#include "shaders_cpu/cloud_scene.h"
#include "tests/shaders/cloudy_sky.h"

using namespace strata;
using namespace strata::cloudy_sky;
using shaders::CloudSide;
using shaders::MediumRay;

namespace {

bool is_sane(const shaders::MediumSegment& segment) {
    bool sane = true;
    for (int c = 0; c < 3; ++c) {
        sane = sane && segment.transmittance[c] >= 0.0f && segment.transmittance[c] <= 1.0f;
        sane = sane && std::isfinite(segment.inscatter[c]) && segment.inscatter[c] >= 0.0f;
    }
    return sane;
}

}  // namespace

TEST_CASE("a layer of any shape covers the share of the plan that it says, within the bound for its threshold") {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit;
    constexpr int kDrawn = 40'000;
    constexpr double kDrawnError = 0.0115;  // Dvoretzky, Kiefer, Wolfowitz: exceeded once in 20 000
    double worst = 0.0;
    for (const double coverage : {0.02, 0.3, 0.5, 0.75, 0.97}) {
        for (const int octaves : {1, 3, 8}) {
            for (const double warp : {0.0, 900.0}) {
                scene::CloudLayer layer{.name = "any", .coverage = coverage, .edge = 0.2 + octaves};
                layer.octaves = octaves;
                layer.warp_m = warp;
                layer.gain = warp > 0.0 ? 0.8 : 0.4;
                layer.stretch = 1.0 + 3.0 * coverage;
                layer.seed = static_cast<std::uint64_t>(octaves) + 10;
                const shaders::CloudField field(layer);
                int covered = 0;
                for (int i = 0; i < kDrawn; ++i) {
                    const glm::dvec2 place = 1e8 * glm::dvec2(unit(random) - 0.5, unit(random) - 0.5);
                    if (field.depth_at(place) > 0.0) ++covered;
                }
                const double off = std::abs(covered / static_cast<double>(kDrawn) - coverage);
                CAPTURE(coverage);
                CAPTURE(octaves);
                CHECK(off <= shaders::CloudField::kCoverageError + kDrawnError);
                worst = std::max(worst, off);
            }
        }
    }
    MESSAGE("largest difference of coverage " << worst);
}

TEST_CASE("a cloud is `depth` deep at `edge`, twice that at most, and never less further in") {
    const shaders::CloudField field({.name = "any", .depth = 7.0});
    CHECK(field.depth(0.0) == 0.0);
    CHECK(field.depth(-1.0) == 0.0);
    CHECK(field.depth(1.0) == doctest::Approx(7.0));
    double before = 0.0;
    for (double excess = 0.01; excess < 50.0; excess *= 1.1) {
        CHECK(field.depth(excess) >= before * 0.99);
        CHECK(field.depth(excess) <= 14.0);
        before = field.depth(excess);
    }
}

TEST_CASE("a footprint over which clouds vanish leaves their mean, a small one leaves all of them") {
    const shaders::CloudField field({.name = "any", .size_m = 1000.0, .octaves = 6});
    const glm::dvec2 place(7654.0, -321.0);
    CHECK(field.excess(place, 1.0).variance == 0.0);
    CHECK(field.excess(place, 1e6).value == doctest::Approx(field.mean_excess().value));
    CHECK(field.excess(place, 1e6).variance == doctest::Approx(field.mean_excess().variance));
    double before = 0.0;
    for (double footprint = 1.0; footprint < 1e5; footprint *= 1.5) {
        CHECK(field.excess(place, footprint).variance >= before);
        before = field.excess(place, footprint).variance;
    }
}

TEST_CASE("lines cross a layer where bisection finds the distance from the Earth's middle to be the layer's") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit;
    const double radius = 6371e3;
    int crossings = 0;
    for (int i = 0; i < 2000; ++i) {
        const double height = i % 3 == 0 ? 60e3 * unit(random) : 3000.0 * unit(random);
        const double altitude = 12e3 * unit(random);
        const double e = (i % 2 == 0 ? 0.02 : 1.5) * (2.0 * unit(random) - 1.0);
        const auto over = [&](double s) {
            const long double x = s * std::cos(e), y = radius + height + s * std::sin(e);
            return static_cast<double>(std::sqrt(x * x + y * y) - (radius + altitude));
        };
        const shaders::CloudCrossings found = shaders::cloud_crossings(radius + height, std::sin(e), altitude - height);
        for (std::size_t k = 0; k < found.count; ++k) {
            const double s = found.at[k], w = 1e-6 * s + 1e-3;
            // Between places a little before and behind the sign changes: bisect.
            double low = s - w, high = s + w;
            if ((over(low) < 0.0) == (over(high) < 0.0)) continue;  // about a tangent
            for (int step = 0; step < 60; ++step) {
                const double middle = 0.5 * (low + high);
                ((over(middle) < 0.0) == (over(low) < 0.0) ? low : high) = middle;
            }
            CHECK(s == doctest::Approx(low).epsilon(1e-7));
            ++crossings;
        }
        // From below one is always met, and nothing is met looking up from above.
        if (height < altitude) CHECK(found.count == 1);
        if (height > altitude && e > 0.0) CHECK(found.count == 0);
    }
    CHECK(crossings > 1500);
}

TEST_CASE(
    "from below clouds stand before the sky alone, from above before the ground, and beyond the horizon nowhere") {
    scene::Scene scene = cloudy();
    scene.clouds.front().coverage = 1.0;
    scene.clouds.front().depth = 50.0;
    const Sky sky(scene);
    const glm::dvec3 low{0.0, 1.0, 0.0}, high{0.0, 60.0, 0.0};
    const glm::dvec3 up = at_elevation(40.0, 1.0), down = at_elevation(-40.0, 1.0);
    CHECK(sky.clouds.opacity({low, up, kInfinity}) > 0.99);
    CHECK(sky.clouds.along({low, up, kInfinity}, CloudSide::above).transmittance.x == 1.0f);
    CHECK(sky.clouds.opacity({low, up, 39.0}) > 0.99);  // 2500 m up at 40 degrees are 38.9 units of 100 m
    CHECK(sky.clouds.opacity({low, up, 38.8}) == 0.0);
    CHECK(sky.clouds.opacity({low, down, kInfinity}) == 0.0);
    CHECK(sky.clouds.opacity({high, up, kInfinity}) == 0.0);
    CHECK(sky.clouds.opacity({high, down, 60.0}) > 0.99);
    CHECK(sky.clouds.along({high, down, 60.0}, CloudSide::below).transmittance.x == 1.0f);
    CHECK(sky.clouds.opacity({high, down, 50.0}) == 0.0);

    // A level look meets the layer, a sphere's, sqrt(2 R h) away; one below the sea's horizon does not.
    const double reach = std::sqrt(2.0 * 6371.5e3 * 2500.0) / 100.0;
    const glm::dvec3 level{0.0, 0.0, 1.0};
    CHECK(sky.clouds.opacity({low, level, 1.001 * reach}) > 0.99);
    CHECK(sky.clouds.opacity({low, level, 0.999 * reach}) == 0.0);
    CHECK(sky.clouds.opacity({low, at_elevation(-2.0, 1.0), kInfinity}) == 0.0);
}

TEST_CASE("layers are finite and never brighten by hiding, at any height of sun and eye and along the horizon") {
    for (const double sun : {-6.0, -0.5, 0.0, 0.3, 20.0, 90.0}) {
        for (const double eye : {-20.0, 0.0, 2599.0, 2600.0, 2601.0, 9000.0, 100e3}) {
            scene::Scene scene = cloudy();
            scene.sun.direction = at_elevation(sun, 0.4);
            scene.clouds.push_back({.name = "high", .altitude_m = 9000.0, .depth = 0.7, .size_m = 20e3});
            const Sky sky(scene, {0.0, eye / 100.0, 0.0});
            for (const double e : {-90.0, -20.0, -3.0, -1.6, -1e-7, 0.0, 1e-7, 0.1, 5.0, 90.0}) {
                for (const double distance : {0.0, 1e-9, 30.0, 1e7, kInfinity}) {
                    const MediumRay ray{{3.0, eye / 100.0, -7.0}, at_elevation(e, 0.3), distance, 1e-3};
                    CHECK(is_sane(sky.clouds.along(ray, CloudSide::below)));
                    CHECK(is_sane(sky.clouds.along(ray, CloudSide::above)));
                    CHECK(is_sane(sky.clouds.mean_along(ray)));
                    if (distance == 0.0) CHECK(sky.clouds.opacity(ray) == 0.0);
                }
            }
            const float light = sky.clouds.sunlight({1.0, eye / 100.0, 2.0}, glm::normalize(scene.sun.direction));
            CHECK(light >= 0.0f);
            CHECK(light <= 1.0f);
            CHECK(std::isfinite(sky.clouds.sky_on_white({0.0, 1.0, 0.0}).y));
        }
    }
}

// Flux through both sides by quadrature over the hemispheres, of sunlight alone.
TEST_CASE("a layer sends on no more sunlight than falls on it, and nearly all of it") {
    for (const double sun : {0.3, 0.6, 1.0}) {
        for (const double depth : {0.1, 0.5, 1.0, 3.0, 10.0, 40.0}) {
            const shaders::CloudSky sky{glm::vec3(1.0f), glm::vec3(0.0f), glm::vec3(0.0f)};
            double sent = std::numbers::pi * sun * std::exp(-depth / sun);
            constexpr int kRings = 200, kAround = 64;
            for (int ring = 0; ring < kRings; ++ring) {
                const double y = -1.0 + 2.0 * (ring + 0.5) / kRings, level = std::sqrt(1.0 - y * y);
                for (int a = 0; a < kAround; ++a) {
                    const double cosine =
                        y * sun + level * std::sqrt(1.0 - sun * sun) * std::cos(2.0 * std::numbers::pi * a / kAround);
                    const shaders::CloudSight sight{
                        .from_below = y > 0.0, .sun_is_beyond = y > 0.0, .sun_cosine = sun, .cosine_turn = cosine};
                    const double opacity = -std::expm1(-depth / std::abs(y));
                    sent += opacity * shaders::cloud_radiance(sky, sight, depth, depth).x * std::abs(y) * 4.0 *
                            std::numbers::pi / (kRings * kAround);
                }
            }
            CAPTURE(sun);
            CAPTURE(depth);
            CHECK(sent < 1.01 * std::numbers::pi * sun);
            CHECK(sent > 0.88 * std::numbers::pi * sun);
        }
    }
}

TEST_CASE("a base is darker where the cloud is deeper, a top brighter, and rims glow about the sun") {
    const shaders::CloudSky sky{glm::vec3(1.0f), glm::vec3(0.2f), glm::vec3(0.1f)};
    const auto seen = [&](bool from_below, double turn, double depth) {
        return shaders::cloud_radiance(sky, {from_below, from_below, 0.6, turn}, depth, depth).y;
    };
    CHECK(seen(true, 0.3, 40.0) < seen(true, 0.3, 10.0));
    CHECK(seen(true, 0.3, 10.0) < seen(true, 0.3, 3.0));
    CHECK(seen(false, 0.3, 40.0) > seen(false, 0.3, 10.0));
    CHECK(seen(true, 0.99, 0.3) > 3.0f * seen(true, 0.3, 0.3));
    CHECK(seen(true, 0.99, 20.0) < 1.3f * seen(true, 0.3, 20.0));
}
