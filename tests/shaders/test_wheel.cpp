#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shaders_cpu/wheel.h"

using namespace strata;
using shaders::wheel;

namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kEdge = 240.0;

// At a radius (fraction of the nearer half side) and an angle in turns, counter-clockwise from the right as seen.
float at(const scene::Wheel& parameters, double radius, double turns, double t) {
    const double angle = 2.0 * std::numbers::pi * turns;
    const double right = kEdge * radius * std::cos(angle);
    const double up = kEdge * radius * std::sin(angle);
    return wheel(parameters, kWidth, kHeight, 0.5 * kWidth + right, 0.5 * kHeight - up, t);
}

}  // namespace

TEST_CASE("hub and rim are black, the outside is white, at any time") {
    const scene::Wheel parameters;
    for (double turns = 0.0; turns < 1.0; turns += 0.013)
        for (const double t : {0.0, 0.3, 17.0}) {
            CHECK(at(parameters, 0.0, turns, t) == 0.0f);
            CHECK(at(parameters, 0.149, turns, t) == 0.0f);
            CHECK(at(parameters, 0.801, turns, t) == 0.0f);
            CHECK(at(parameters, 0.899, turns, t) == 0.0f);
            CHECK(at(parameters, 0.901, turns, t) == 1.0f);
            CHECK(at(parameters, 1.3, turns, t) == 1.0f);
        }
}

TEST_CASE("spokes are as many as asked for, evenly spread, and fill their share of the angle") {
    for (const int spokes : {1, 5, 12, 100})
        for (const double fill : {0.1, 0.4, 0.9}) {
            const scene::Wheel parameters{spokes, 0.5, fill};
            constexpr int kSteps = 100000;
            int edges = 0;
            int black = 0;
            for (int i = 0; i < kSteps; ++i) {
                const float here = at(parameters, 0.5, (i + 0.5) / kSteps, 0.0);
                edges += here != at(parameters, 0.5, (i + 1.5) / kSteps, 0.0);
                black += here == 0.0f;
            }
            CHECK(edges == 2 * spokes);
            CHECK(static_cast<double>(black) / kSteps == doctest::Approx(fill).epsilon(0.01));
            CHECK(at(parameters, 0.5, 0.0, 0.0) == 0.0f);  // one points right
        }
    CHECK(at({12, 0.5, 0.0}, 0.5, 0.0, 0.0) == 1.0f);
    CHECK(at({12, 0.5, 1.0}, 0.5, 0.5 / 12, 0.0) == 0.0f);
}

TEST_CASE("the wheel repeats every 1 / (spokes * turns_per_s) seconds, and no sooner") {
    const scene::Wheel parameters{12, 1.9, 0.4};
    const double period = 1.0 / (12 * 1.9);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit;
    int differ_at_period = 0;
    int differ_at_half = 0;
    for (int i = 0; i < 20000; ++i) {
        const double radius = 0.2 + 0.55 * unit(random);
        const double turns = unit(random);
        const double t = unit(random);
        const float now = at(parameters, radius, turns, t);
        differ_at_period += at(parameters, radius, turns, t + period) != now;
        differ_at_period += at(parameters, radius, turns, t - 3 * period) != now;
        differ_at_half += at(parameters, radius, turns, t + 0.5 * period) != now;
    }
    CHECK(differ_at_period == 0);
    CHECK(differ_at_half > 5000);
}

TEST_CASE("the wheel turns counter-clockwise on the screen, a negative speed clockwise") {
    for (const double speed : {0.5, -0.5, 3.0}) {
        const scene::Wheel parameters{12, speed, 0.4};
        for (const double t : {0.001, 0.005, 0.2}) {
            // The wheel at time t is the wheel at rest turned by speed * t.
            int differ = 0;
            for (double turns = 0.0003; turns < 1.0; turns += 0.001)
                differ += at(parameters, 0.5, turns + speed * t, t) != at(parameters, 0.5, turns, 0.0);
            CHECK(differ == 0);
        }
    }
    // The spoke that points right moves up: its upper edge is at 0.4 / 24 turns, then beyond.
    const scene::Wheel parameters{12, 0.5, 0.4};
    CHECK(wheel(parameters, kWidth, kHeight, 320 + 120, 240 - 16, 0.0) == 1.0f);
    CHECK(wheel(parameters, kWidth, kHeight, 320 + 120, 240 - 16, 0.02) == 0.0f);
    CHECK(wheel(parameters, kWidth, kHeight, 320 + 120, 240 + 10, 0.0) == 0.0f);
    CHECK(wheel(parameters, kWidth, kHeight, 320 + 120, 240 + 10, 0.02) == 1.0f);
}

TEST_CASE("averaged over one period the spokes are an even disc") {
    const scene::Wheel parameters{12, 1.9, 0.4};
    const double period = 1.0 / (12 * 1.9);
    for (const double radius : {0.2, 0.5, 0.79})
        for (const double turns : {0.0, 0.03, 0.31}) {
            double sum = 0.0;
            for (int i = 0; i < 10000; ++i) sum += at(parameters, radius, turns, (i + 0.5) / 10000 * period);
            CHECK(sum / 10000 == doctest::Approx(0.6).epsilon(1e-3));
        }
}

TEST_CASE("the wheel is the same picture at any size") {
    std::mt19937 random(10);
    std::uniform_real_distribution<double> unit;
    int different = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = unit(random);
        const double y = unit(random);
        different += wheel({}, 160, 90, 160 * x, 90 * y, 0.1) != wheel({}, 1920, 1080, 1920 * x, 1080 * y, 0.1);
    }
    CHECK(different == 0);
}

TEST_CASE("the wheel is black or white for extreme parameters, frames and times") {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 20000}, {960, 540}})
        for (const double speed : {-1e6, 0.0, 1e6})
            for (const double t : {-1e9, 0.0, 1e-300, 1e9})
                for (const double u : {-1e9, 0.5 * width, 0.3 * width, 1e9}) {
                    const float value = wheel({1000, speed, 0.5}, width, height, u, 0.4 * height, t);
                    CHECK((value == 0.0f || value == 1.0f));
                }
}
