#include "src/image/agx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "src/image/luminance.h"

using namespace strata::image;

namespace {

// Columns X, Y and Z of the primaries whose chromaticities are these, at amounts that add up to the white.
glm::dmat3 primaries(const std::array<glm::dvec2, 3>& xy, const glm::dvec2& white) {
    const auto XYZ = [](const glm::dvec2& c) { return glm::dvec3(c.x, c.y, 1.0 - c.x - c.y) / c.y; };
    glm::dmat3 m(XYZ(xy[0]), XYZ(xy[1]), XYZ(xy[2]));
    const glm::dvec3 amounts = glm::inverse(m) * XYZ(white);
    for (int c = 0; c < 3; ++c) m[c] *= amounts[c];
    return m;
}

}  // namespace

TEST_CASE("the inset is that of primaries a quarter farther from white, and the outset its inverse") {
    const glm::dvec2 white(0.3127, 0.3290);
    const std::array<glm::dvec2, 3> rec709{glm::dvec2(0.64, 0.33), glm::dvec2(0.30, 0.60), glm::dvec2(0.15, 0.06)};
    std::array<glm::dvec2, 3> wide = rec709;
    for (glm::dvec2& c : wide) c = white + (c - white) / (1.0 - kAgxInset);
    const glm::dmat3 inset = glm::inverse(primaries(wide, white)) * primaries(rec709, white);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            const double own = row == column ? 1.0 - kAgxInset : 0.0;
            CHECK(inset[column][row] == doctest::Approx(own + kAgxShare[column]).epsilon(1e-12));
        }
    }
    // Near grey the sigmoid is straight, so that what the inset took from a colour the outset gives back: the channels
    // differ as greys of their light do. Without the outset they would differ by a fifth less.
    const Agx agx;
    const auto grey = [&](double light) { return agx.displayed(glm::dvec3(light), 1.0).r; };
    const glm::dvec3 light = kMidGrey * glm::dvec3(1.001, 1.0, 0.999);
    const glm::dvec3 shown = agx.displayed(light, 1.0);
    CHECK((shown.r - shown.g) / (grey(light.r) - grey(light.g)) == doctest::Approx(1.0).epsilon(0.005));
    CHECK((shown.g - shown.b) / (grey(light.g) - grey(light.b)) == doctest::Approx(1.0).epsilon(0.005));
}

TEST_CASE("the curve is the published one, darker by no more than its pivot is") {
    // A polynomial that others fitted to the published curve, to 0.005.
    const auto fit = [](double x) {
        return ((((((15.5 * x - 40.14) * x + 31.96) * x) - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
    };
    constexpr double kPublishedPivot = 0.5;
    const double lower = kPublishedPivot - std::pow(kMidGrey, 1 / 2.2);
    const Agx agx;
    double farthest = 0.0;
    for (double x = 0.0; x <= 1.0; x += 1.0 / 256) {
        const double difference = fit(x) - agx.sigmoid(x);
        farthest = std::max(farthest, std::max(-difference, difference - lower));
    }
    CHECK(farthest < 0.006);
}

TEST_CASE("the sigmoid goes from 0 to 1 and is as steep at mid grey as contrast says") {
    for (const double contrast : {0.7, 1.0, 1.4, 2.0}) {
        const Agx agx(contrast);
        const double pivot = -kAgxDarkest / (kAgxBrightest - kAgxDarkest);
        CHECK(agx.sigmoid(0.0) < 1e-14);
        CHECK(agx.sigmoid(1.0) > 1.0 - 1e-14);
        CHECK(std::pow(agx.sigmoid(pivot), 2.2) == doctest::Approx(kMidGrey).epsilon(1e-12));
        const double h = 1e-6;
        const double slope = (agx.sigmoid(pivot + h) - agx.sigmoid(pivot - h)) / (2 * h);
        CHECK(slope == doctest::Approx(2.0 * contrast).epsilon(1e-4));
    }
}
