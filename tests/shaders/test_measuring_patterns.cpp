#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "shaders_cpu/constant.h"
#include "shaders_cpu/edge.h"
#include "shaders_cpu/ramp.h"

using namespace strata;

TEST_CASE("an edge has its white side where its angle points, its offset from the frame's centre") {
    CHECK(shaders::edge({0.0, 0.0}, 40, 20, 20.5, 3, 0) == 1.0f);  // right
    CHECK(shaders::edge({0.0, 0.0}, 40, 20, 19.5, 3, 0) == 0.0f);
    CHECK(shaders::edge({90.0, 0.0}, 40, 20, 3, 9.5, 0) == 1.0f);  // up, so smaller v
    CHECK(shaders::edge({90.0, 0.0}, 40, 20, 3, 10.5, 0) == 0.0f);
    CHECK(shaders::edge({0.0, 2.0}, 40, 20, 21.5, 3, 0) == 0.0f);
    CHECK(shaders::edge({0.0, 2.0}, 40, 20, 22.5, 3, 0) == 1.0f);
}

TEST_CASE("an edge and its opposite are each other's negative off the edge") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 2000; ++i) {
        const double angle = 720 * unit(random) - 360;
        const double offset = 8 * unit(random) - 4;
        const double u = 64 * unit(random);
        const double v = 36 * unit(random);
        CAPTURE(angle);
        CHECK(shaders::edge({angle, offset}, 64, 36, u, v, 0) +
                  shaders::edge({angle + 180, -offset}, 64, 36, u, v, 0) ==
              1.0f);
    }
}

TEST_CASE("a ramp is 1/2 in the middle, rises by `rise` over the frame's width, and its mean value is its centre's") {
    CHECK(shaders::ramp({0.0, 1.0}, 40, 20, 20, 10, 0) == 0.5f);
    CHECK(shaders::ramp({0.0, 1.0}, 40, 20, 40, 3, 0) == 1.0f);
    CHECK(shaders::ramp({90.0, 1.0}, 40, 20, 3, 0, 0) == doctest::Approx(0.75));
    CHECK(shaders::ramp({180.0, 3.0}, 40, 20, 40, 3, 0) == doctest::Approx(-1.0));
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < 500; ++i) {
        const scene::Ramp ramp{720 * unit(random), 2 * unit(random)};
        const double u = 40 * unit(random), v = 20 * unit(random), du = unit(random), dv = unit(random);
        const double mean = 0.5 * (static_cast<double>(shaders::ramp(ramp, 40, 20, u - du, v - dv, 0)) +
                                   static_cast<double>(shaders::ramp(ramp, 40, 20, u + du, v + dv, 0)));
        CHECK(static_cast<double>(shaders::ramp(ramp, 40, 20, u, v, 0)) == doctest::Approx(mean).epsilon(1e-6));
    }
}

TEST_CASE("a constant is its value") { CHECK(shaders::constant({0.25}, 4, 4, 1, 2, 3) == 0.25f); }
