#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "src/filter/bspline.h"
#include "tests/filter/bspline_oracle.h"

using namespace strata::filter;
using oracle::Real;

namespace {

// Log-uniform and uniform tail probabilities, extremes, and those at and around the knots.
std::vector<double> tail_probabilities(int m, std::mt19937_64& random) {
    std::vector<double> tails{std::numeric_limits<double>::denorm_min(),
                              1e-300,
                              1e-200,
                              1e-100,
                              1e-30,
                              1e-16,
                              1e-12,
                              1e-8,
                              1e-4,
                              0.25,
                              std::nextafter(0.5, 0.0),
                              0.5};
    std::uniform_real_distribution<double> exponent(-300, -1);
    std::uniform_real_distribution<double> near_exponent(-12, -1);
    std::uniform_real_distribution<double> uniform(0, 0.5);
    for (int i = 0; i < 8; ++i) tails.push_back(std::pow(10.0, exponent(random)));
    for (int i = 0; i < 8; ++i) tails.push_back(std::pow(10.0, near_exponent(random)));
    for (int i = 0; i < 8; ++i) tails.push_back(uniform(random));
    for (int knot = 1; knot <= m / 2; knot += 1 + m / 12) {
        const double p = std::min(0.5, bspline_cdf(m, knot));
        for (double q : {std::nextafter(p, 0.0), p, std::nextafter(p, 0.5)}) tails.push_back(q);
    }
    return tails;
}

// The distance from x to the root, by one Newton step in 400 bits: from within 1e-13 its own error is below 1e-25.
double tail_error(int m, const Real& x, const Real& p) {
    const oracle::Spline at = oracle::spline(m, x);
    return std::abs(static_cast<double>((at.cdf - p) / at.pdf));
}

}  // namespace

TEST_CASE("the inverse is within its error bound at every order, from both ends, for every magnitude of y") {
    std::mt19937_64 random(1);
    double worst = 0;
    int most_iterations = 0;
    for (int m = kMinOrder; m <= kMaxOrder; ++m) {
        for (double p : tail_probabilities(m, random)) {
            CAPTURE(m);
            CAPTURE(p);
            const Inversion lower = bspline_invert(m, p);
            REQUIRE(lower.x > 0);
            REQUIRE(lower.x <= 0.5 * m);
            REQUIRE(lower.x == bspline_inverse_tail(m, p));
            REQUIRE(lower.x == bspline_inverse_cdf(m, p));
            worst = std::max(worst, tail_error(m, lower.x, p));
            most_iterations = std::max(most_iterations, lower.iterations);

            const double y = 1 - p;  // rounded; its own complement is exact
            if (y < 1) {
                const double upper = bspline_inverse_cdf(m, y);
                REQUIRE(upper >= 0.5 * m);
                REQUIRE(upper <= m);
                worst = std::max(worst, tail_error(m, m - Real(upper), 1 - Real(y)));
            }
            REQUIRE(worst <= kInverseError);
        }
    }
    MESSAGE("max observed / bound: " << worst / kInverseError << ", most iterations " << most_iterations);
}

TEST_CASE("the ends of [0,1] and what lies beyond map to the ends of the support, one half to its centre") {
    for (int m = kMinOrder; m <= kMaxOrder; ++m) {
        CAPTURE(m);
        for (double y : {-1.0, -0.0, 0.0}) CHECK(bspline_inverse_cdf(m, y) == 0);
        for (double y : {1.0, 2.0}) CHECK(bspline_inverse_cdf(m, y) == m);
        CHECK(std::abs(bspline_inverse_cdf(m, 0.5) - 0.5 * m) <= kInverseError);
        CHECK(bspline_inverse_tail(m, 0.7) == bspline_inverse_tail(m, 0.5));
        CHECK(bspline_inverse_cdf(m, 0x1p-53) + bspline_inverse_cdf(m, 1 - 0x1p-53) ==
              doctest::Approx(m).epsilon(1e-15));
    }
}

TEST_CASE("the inverse increases with y") {
    std::vector<double> ys;
    for (int k = -300; k < -2; ++k) ys.push_back(std::pow(10.0, k));
    for (int k = 10; k <= 990; ++k) ys.push_back(k / 1000.0);
    for (int k = 10; k <= 50; ++k) ys.push_back(1 - std::pow(2.0, -k));
    std::sort(ys.begin(), ys.end());
    for (int m = kMinOrder; m <= kMaxOrder; ++m) {
        double previous = 0;
        for (double y : ys) {
            const double x = bspline_inverse_cdf(m, y);
            CAPTURE(m);
            CAPTURE(y);
            REQUIRE(x > previous);
            previous = x;
        }
    }
}

TEST_CASE("a last Halley step leaves no more than the named factor times its cube") {
    double worst = 0;
    for (int m = 3; m <= kMaxOrder; m += m < 16 ? 1 : 12) {
        const int points = m < 16 ? 60 : 25;
        for (int i = 0; i < points; ++i) {
            const Real root = 1 + (Real(m) / 2 - 1) * (i + Real(0.01)) / points;
            const Real p = oracle::spline(m, root).cdf;
            for (double offset : {-1e-5, 1e-5}) {
                const Real x = root + offset;
                if (x < 1 || 2 * x > m) continue;
                const oracle::Spline at = oracle::spline(m, x);
                const Real r = at.cdf / at.pdf;
                const Real newton = m * r * (pow(p / at.cdf, Real(1) / m) - 1);
                const Real curvature = at.derivative / at.pdf - (1 - Real(1) / m) / r;
                const Real step = newton / (1 + newton * curvature / 2);
                const Real left = x + step - root;
                worst = std::max(worst, std::abs(static_cast<double>(left / (step * step * step))));
            }
        }
    }
    CHECK(worst <= kHalleyCubic);
    CHECK(worst >= 0.5 * kHalleyCubic);
    MESSAGE("max observed / bound: " << worst / kHalleyCubic);
}
