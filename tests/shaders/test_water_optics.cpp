// What water does with light, held against the laws in another form, and against integrals that are known.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shaders_cpu/water.h"
#include "shaders_cpu/water_optics.h"
#include "shaders_cpu/water_waves.h"

using namespace strata;
using namespace strata::shaders;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

glm::dvec3 from_angles(double height_deg, double turn_deg) {
    const double a = height_deg * kDegree, b = turn_deg * kDegree;
    return {std::cos(a) * std::cos(b), std::sin(a), std::cos(a) * std::sin(b)};
}

}  // namespace

// Fresnel's formulas by the angles themselves.
TEST_CASE("the share of light that water reflects is Fresnel's, from straight down to grazing") {
    for (const double deg : {0.01, 1.0, 20.0, 45.0, 53.12, 60.0, 80.0, 89.0, 89.99}) {
        const double in = deg * kDegree, below = std::asin(std::sin(in) / kWaterIndex);
        const double across = std::sin(in - below) / std::sin(in + below);
        const double along = std::tan(in - below) / std::tan(in + below);
        CAPTURE(deg);
        CHECK(fresnel(std::cos(in)) == doctest::Approx(0.5 * (across * across + along * along)).epsilon(1e-9));
    }
    CHECK(fresnel(1.0) == doctest::Approx(std::pow(0.333 / 2.333, 2.0)).epsilon(1e-12));
    CHECK(fresnel(0.0) == 1.0);
    CHECK(fresnel(-0.1) == 1.0);
    CHECK(even_light_reflected() / 0.0663 == doctest::Approx(1.0).epsilon(0.01));  // 6.6 %: Jerlov, Marine Optics, 1976
}

TEST_CASE("light goes into water by Snell's law, and looks out of it the way that it came") {
    for (const double height : {0.01, 3.0, 30.0, 75.0, 90.0}) {
        CAPTURE(height);
        const glm::dvec3 down = -from_angles(height, 50.0), below = refracted(down, {0.0, 1.0, 0.0});
        CHECK(glm::length(below) == doctest::Approx(1.0).epsilon(1e-14));
        CHECK(std::hypot(below.x, below.z) * kWaterIndex == doctest::Approx(std::hypot(down.x, down.z)).epsilon(1e-12));
        CHECK(below.y < 0.0);
        CHECK(glm::distance(out_of_water(-below), -down) < 1e-6);
    }
}

TEST_CASE("slopes that a sample tells and those that it does not have together Cox and Munk's mean square") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-1e3, 1e3);
    for (const double wind : {0.2, 3.0}) {
        const WaterWaves waves(wind, 2.0);
        for (const double footprint : {0.0, 0.02, 0.23, 0.75, 40.0}) {  // at 0.23 and 0.75 an octave is half gone
            CAPTURE(wind);
            CAPTURE(footprint);
            constexpr int kPoints = 150000;
            double sum = 0.0;
            for (int i = 0; i < kPoints; ++i) {
                const WaveSlopes slopes = waves.at({place(random), 0.0, place(random)}, footprint);
                sum += glm::dot(slopes.mean, slopes.mean) + 2.0 * slopes.variance;
                REQUIRE(slopes.variance >= waves.finest_variance());
            }
            CHECK(sum / kPoints / mean_square_slope(wind) == doctest::Approx(1.0).epsilon(0.005));
        }
    }
    CHECK(mean_square_slope(10.0) == doctest::Approx(0.0542));
    CHECK(mean_square_slope(0.0) == 0.0);
    CHECK(WaterWaves(0.0, 2.0).is_calm());
}

// By a sum over slopes.
TEST_CASE("facets are drawn as often as an eye sees their area, at any height of the eye") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double height : {0.01, 2.0, 15.0, 60.0, 90.0}) {
        const WaveSlopes slopes{.mean = {0.03, -0.02}, .variance = 0.01};
        const glm::dvec3 to_eye = from_angles(height, 30.0);
        const VisibleFacets facets(slopes, to_eye);
        const auto seen = [&](const glm::dvec2& slope) {
            return std::max(glm::dot(to_eye, glm::dvec3(-slope.x, 1.0, -slope.y)), 0.0);
        };
        double area = 0.0;
        glm::dvec2 first(0.0), second(0.0);
        constexpr int kSteps = 400;
        for (int i = 0; i < kSteps; ++i) {
            for (int j = 0; j < kSteps; ++j) {
                const glm::dvec2 slope = slopes.mean + glm::dvec2((i + 0.5) / kSteps - 0.5, (j + 0.5) / kSteps - 0.5);
                const double share = facets.density(slope) / (kSteps * kSteps) * seen(slope);
                area += share;
                first += share * slope;
                second += share * slope * slope;
            }
        }
        CAPTURE(height);
        CHECK(facets.area() / area == doctest::Approx(1.0).epsilon(1e-3));
        glm::dvec2 drawn(0.0), drawn2(0.0);
        constexpr int kDraws = 20000;
        for (int i = 0; i < kDraws; ++i) {
            const glm::dvec2 slope = facets.draw(unit(random), unit(random));
            REQUIRE(seen(slope) >= 0.0);
            drawn += slope / static_cast<double>(kDraws);
            drawn2 += slope * slope / static_cast<double>(kDraws);
        }
        for (const int axis : {0, 1}) {
            CHECK(std::abs(drawn[axis] - first[axis] / area) < 4.0 * 0.1 / std::sqrt(kDraws));
            CHECK(drawn2[axis] / (second[axis] / area) == doctest::Approx(1.0).epsilon(0.02));
        }
    }
}

TEST_CASE("a facet is drawn from any numbers, of any eye that looks down, and is never turned to nothing") {
    for (const double height : {1e-9, 1e-3, 0.01, 1.0, 90.0}) {
        for (const double variance : {0.0, 1e-30, 1e-8, 0.1}) {
            for (const double lean : {-2.0, -0.1, 0.0, 0.1, 2.0}) {
                const VisibleFacets facets({.mean = {lean, 0.0}, .variance = variance}, from_angles(height, 0.0));
                for (const double u : {1e-10, 0.5, 1.0 - 1e-10}) {
                    const glm::dvec2 slope = facets.draw(u, 1.0 - u);
                    REQUIRE(std::isfinite(slope.x));
                    REQUIRE(std::isfinite(slope.y));
                    REQUIRE(std::isfinite(facets.area()));
                }
            }
        }
    }
}

// Over directions by even steps of height and turn.
TEST_CASE("waves send on all of a beam's light: what they mirror of beams from everywhere is one whole") {
    for (const double height : {0.5, 10.0, 40.0, 90.0}) {
        const glm::dvec3 to_eye = from_angles(height, 20.0);
        const WaveSlopes slopes{.mean = {0.02, 0.01}, .variance = 0.03};
        double sum = 0.0;
        constexpr int kRows = 1440, kColumns = 1440;
        for (int i = 0; i < kRows; ++i) {
            const double deg = -90.0 + 180.0 * (i + 0.5) / kRows;
            const double solid = (180.0 / kRows) * (360.0 / kColumns) * kDegree * kDegree * std::cos(deg * kDegree);
            for (int j = 0; j < kColumns; ++j)
                sum += solid * mirrored_beam(slopes, to_eye, from_angles(deg, 360.0 * j / kColumns), 0.0);
        }
        CAPTURE(height);
        CHECK(sum == doctest::Approx(1.0).epsilon(0.01));
    }
}

TEST_CASE("no glint is brighter than the sun's disc, however calm the water and low the eye") {
    const double radius = 0.2666 * kDegree, brightest = 1.0 / (kPi * std::pow(std::sin(radius), 2.0));
    double most = 0.0;
    for (const double variance : {0.0, 1e-9, 1e-5, 1e-2}) {
        for (const double height : {0.01, 0.5, 10.0, 80.0}) {
            const double radiance = mirrored_beam({.mean = glm::dvec2(0.0), .variance = variance},
                                                  from_angles(height, 0.0), from_angles(height, 180.0), radius);
            CHECK(radiance <= brightest * (1.0 + 1e-12));
            most = std::max(most, radiance);
        }
    }
    CHECK(most == doctest::Approx(brightest));
}

// The sun's disc of radius r is one of normals with the variance r^2 / 16 along an axis: r^2 / 4 with waves of three
// times that. Sunlight from 2 r beside the mirror's direction has normals r beside the waves'.
TEST_CASE("the sun's disc widens its glint as much as its own size") {
    const double radius = 0.01;
    const WaveSlopes waves{.mean = glm::dvec2(0.0), .variance = 3.0 * radius * radius / 16.0};
    const auto glint = [&](double off) {
        return mirrored_beam(waves, {0.0, 1.0, 0.0}, {std::sin(off), std::cos(off), 0.0}, radius);
    };
    CHECK(glint(2.0 * radius) / glint(0.0) == doctest::Approx(std::exp(-2.0)).epsilon(1e-3));
}

TEST_CASE("a white bed under water that takes nothing sends all even light back; with depth it fades as Beer says") {
    scene::Scene scene;
    scene.scale.metres = 10.0;
    scene.water.absorption = {0.5, 0.0, 0.1};
    const Water water(scene);
    const glm::vec3 white(1.0f), near = water.even_light_at(0.0) * water.again_and_again(white, 0.0);
    for (const int c : {0, 1, 2}) CHECK(near[c] == doctest::Approx(1.0));
    CHECK(water.left_after(0.2).r == doctest::Approx(std::exp(-1.0)));
    CHECK(water.left_after(1e9).g == 1.0f);
    CHECK(water.left_after(1e9).r == 0.0f);
    CHECK(water.even_light_at(0.3).b / water.even_light_at(0.0).b ==
          doctest::Approx(std::exp(-0.3 * 1.2039)).epsilon(1e-4));
    CHECK(std::isinf(water.sight()));
    const double steep = std::sqrt(1.0 - std::pow(std::cos(30.0 * kDegree) / kWaterIndex, 2.0));
    CHECK(water.beam_at(from_angles(30.0, 0.0), 0.3).b / water.beam_at(from_angles(30.0, 0.0), 0.0).b ==
          doctest::Approx(std::exp(-0.3 / steep)).epsilon(1e-4));
    CHECK(water.beam_at(from_angles(-1.0, 0.0), 0.3) == glm::vec3(0.0f));
}

// A beam as even light is made of: the mean of beam_at over directions by their cosine.
TEST_CASE("even light is the mean of beams") {
    scene::Scene scene;
    scene.water.absorption = glm::dvec3(0.0);
    const Water water(scene);
    double sum = 0.0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = std::sqrt((i + 0.5) / kSteps),
                     below = std::sqrt(1.0 - (1.0 - cosine * cosine) / (kWaterIndex * kWaterIndex));
        const glm::dvec3 to_light{std::sqrt(1.0 - cosine * cosine), cosine, 0.0};
        sum += static_cast<double>(water.beam_at(to_light, 0.0).g) * below / cosine / kSteps;
    }
    CHECK(sum == doctest::Approx(static_cast<double>(water.even_light_at(0.0).g)).epsilon(1e-3));
}
