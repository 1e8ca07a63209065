#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "shaders_cpu/zoneplate.h"

using namespace strata;
using shaders::zoneplate;

namespace {

// Radii at which the pattern falls through 1/2 along a ray from the centre, in order: one a period.
std::vector<double> falls(const scene::Zoneplate& parameters, int width, int height, double limit) {
    const auto bright = [&](double r) {
        return zoneplate(parameters, width, height, 0.5 * width + r, 0.5 * height, 0.0) > 0.5f;
    };
    std::vector<double> radii;
    constexpr double kStep = 0.01;
    for (double r = 0.0; r < limit; r += kStep) {
        if (!bright(r) || bright(r + kStep)) continue;
        double low = r;
        double high = r + kStep;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (low + high);
            (bright(middle) ? low : high) = middle;
        }
        radii.push_back(low);
    }
    return radii;
}

}  // namespace

TEST_CASE("the zone plate is the same in every direction, white in the middle, still and within [0,1]") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit;
    for (const double rings : {0.0, 3.7, 250.0}) {
        const scene::Zoneplate parameters{rings};
        double worst = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const double r = 300.0 * unit(random);
            const double a = 2.0 * std::numbers::pi * unit(random);
            const double b = 2.0 * std::numbers::pi * unit(random);
            const double one = zoneplate(parameters, 640, 480, 320 + r * std::cos(a), 240 + r * std::sin(a), 0.0);
            const double other = zoneplate(parameters, 640, 480, 320 + r * std::cos(b), 240 + r * std::sin(b), 9.0);
            CHECK((one >= 0.0 && one <= 1.0));
            worst = std::max(worst, std::fabs(one - other));
        }
        CHECK(worst < 1e-6);
        CHECK(zoneplate(parameters, 640, 480, 320, 240, 0.0) == 1.0f);
    }
}

TEST_CASE("by default the local frequency reaches half a cycle a pixel at the nearer edge") {
    for (const auto& [width, height] : {std::pair{512, 512}, {640, 480}, {301, 700}}) {
        const double edge = 0.5 * std::min(width, height);
        const std::vector<double> fall = falls({}, width, height, edge + 4.0);
        // Between neighbours lies one period; the phase is quadratic, so the frequency half-way between them is exactly
        // one over their distance.
        double frequency = 0.0;
        double radius = 0.0;
        for (std::size_t i = 1; i < fall.size() && fall[i] <= edge + 2.0; ++i) {
            frequency = 1.0 / (fall[i] - fall[i - 1]);
            radius = 0.5 * (fall[i] + fall[i - 1]);
        }
        REQUIRE(radius > edge - 4.0);
        CHECK(frequency * edge / radius == doctest::Approx(0.5).epsilon(1e-5));
    }
}

TEST_CASE("rings counts the periods from the centre to the nearer edge") {
    for (const double rings : {5.0, 12.0, 20.0})
        CHECK(falls({rings}, 400, 300, 150.0).size() == static_cast<std::size_t>(rings));
}

TEST_CASE("the zone plate with given rings is the same picture at any size") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 10000; ++i) {
        const double x = unit(random);
        const double y = unit(random);
        const double small = zoneplate({9.5}, 160, 90, 160 * x, 90 * y, 0.0);
        CHECK(zoneplate({9.5}, 1920, 1080, 1920 * x, 1080 * y, 0.0) == doctest::Approx(small).epsilon(1e-5));
    }
}

TEST_CASE("the zone plate is finite for extreme frames, rings and places") {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 20000}, {20000, 1}})
        for (const double rings : {0.0, 1e-300, 1e9})
            for (const double u : {-1e9, 0.0, 0.5, 1e9}) {
                const float value = zoneplate({rings}, width, height, u, -u, 1e9);
                CHECK((value >= 0.0f && value <= 1.0f));
            }
}
