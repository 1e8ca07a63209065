#include "src/filter/bspline.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/filter/bspline_oracle.h"
#include "tests/filter/quadrature.h"

using namespace strata::filter;
using oracle::integrate;
using oracle::Real;

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRoundingBound = 16 * kEpsilon;

// Random points, knots, their neighbours and extremes of [0,m/2].
std::vector<double> lower_points(int m, std::mt19937_64& random) {
    const double half = 0.5 * m;
    std::vector<double> points{0.0, 0x1p-1022, 1e-100, 1e-10, 1e-3, half, std::nextafter(half, 0.0)};
    std::uniform_real_distribution<double> uniform(0, half);
    for (int i = 0; i < 12; ++i) points.push_back(uniform(random));
    for (int i = 0; i < 3; ++i) {
        const double knot = std::floor(uniform(random));
        for (double x : {knot, std::nextafter(knot, 1e9), std::nextafter(knot, -1.0)})
            if (x >= 0) points.push_back(x);
    }
    return points;
}

double relative_error(double value, const Real& exact) {
    return std::abs(static_cast<double>((value - exact) / exact));
}

double absolute_error(double value, const Real& exact) { return std::abs(static_cast<double>(value - exact)); }

bool is_normal(const Real& exact) { return exact > std::numeric_limits<double>::min(); }

}  // namespace

TEST_CASE("density and distribution agree with 400-bit truncated powers at every order") {
    std::mt19937_64 random(1);
    double worst_cdf = 0;
    double worst_pdf = 0;
    for (int m = kMinOrder; m <= kMaxOrder; ++m) {
        for (double x : lower_points(m, random)) {
            const oracle::Spline exact = oracle::spline(m, x);
            CAPTURE(m);
            CAPTURE(x);
            if (is_normal(exact.cdf)) {
                worst_cdf = std::max(worst_cdf, relative_error(bspline_cdf(m, x), exact.cdf));
                if (m - (m - x) == x) {
                    worst_cdf = std::max(worst_cdf, relative_error(bspline_survival(m, m - x), exact.cdf));
                }
            }
            if (is_normal(exact.pdf)) {
                worst_pdf = std::max(worst_pdf, relative_error(bspline_pdf(m, x), exact.pdf));
            }
            REQUIRE(worst_cdf <= kRoundingBound);
            REQUIRE(worst_pdf <= kRoundingBound);
        }
    }
    MESSAGE("max observed / bound: cdf " << worst_cdf / kRoundingBound << ", pdf " << worst_pdf / kRoundingBound);
}

TEST_CASE("the upper half agrees with the unfolded truncated powers") {
    std::mt19937_64 random(2);
    for (int m : {1, 2, 3, 4, 5, 8, 15, 30, 61, 100}) {
        std::uniform_real_distribution<double> upper(0.5 * m, m);
        for (int i = 0; i < 30; ++i) {
            const double x = upper(random);
            const oracle::Spline exact = oracle::spline(m, x);
            CAPTURE(m);
            CAPTURE(x);
            CHECK(absolute_error(bspline_cdf(m, x), exact.cdf) <= kRoundingBound);
            CHECK(absolute_error(bspline_survival(m, x), 1 - exact.cdf) <= kRoundingBound);
            CHECK(absolute_error(bspline_pdf(m, x), exact.pdf) <= kRoundingBound);
        }
    }
}

TEST_CASE("splines at all integer shifts add up to one") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> fraction(0, 1);
    for (int m = kMinOrder; m <= kMaxOrder; ++m) {
        for (double f : {0.0, 0x1p-40, fraction(random), fraction(random), 1 - 0x1p-40}) {
            double sum = 0;
            for (int j = 0; j < m; ++j) sum += bspline_pdf(m, f + j);
            CAPTURE(m);
            CAPTURE(f);
            CHECK(std::abs(sum - 1) <= kRoundingBound);
        }
    }
}

TEST_CASE("the distribution is the integral of the density") {
    std::mt19937_64 random(4);
    constexpr double kQuadratureBound = 1e-14;  // rounding of a sum of up to 6000 terms adding up to one
    double worst = 0;
    for (int m = kMinOrder; m <= kMaxOrder; m += m < 20 ? 1 : 7) {
        const auto pdf = [m](double x) { return bspline_pdf(m, x); };
        worst = std::max(worst, std::abs(integrate(pdf, 0, m) - 1));
        std::uniform_real_distribution<double> support(0, m);
        for (int i = 0; i < 3; ++i) {
            const double x = support(random);
            worst = std::max(worst, std::abs(integrate(pdf, 0, x) - bspline_cdf(m, x)));
        }
        CAPTURE(m);
        REQUIRE(worst <= kQuadratureBound);
    }
    MESSAGE("max observed / bound: " << worst / kQuadratureBound);
}

TEST_CASE("density and distribution are mirror symmetric about m/2") {
    std::mt19937_64 random(5);
    for (int m = kMinOrder; m <= kMaxOrder; ++m) {
        std::uniform_int_distribution<int> grid(1, 4096 * m - 1);
        for (int i = 0; i < 20; ++i) {
            const double x = grid(random) / 4096.0;  // so that m - x is exact
            CAPTURE(m);
            CAPTURE(x);
            CHECK(bspline_pdf(m, x) == bspline_pdf(m, m - x));
            CHECK(bspline_cdf(m, x) == bspline_survival(m, m - x));
            CHECK(std::abs(bspline_cdf(m, x) + bspline_survival(m, x) - 1) <= kEpsilon);
        }
    }
}

TEST_CASE("outside the support, and for NaN, the functions take their limits") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int m : {1, 2, 3, 4, 15, 100}) {
        CAPTURE(m);
        for (double x : {-infinity, -1.0, -1e-300, 0.0}) {
            CHECK(bspline_cdf(m, x) == 0);
            CHECK(bspline_survival(m, x) == 1);
        }
        for (double x : {static_cast<double>(m), m + 1.0, infinity}) {
            CHECK(bspline_pdf(m, x) == 0);
            CHECK(bspline_cdf(m, x) == 1);
            CHECK(bspline_survival(m, x) == 0);
        }
        CHECK(bspline_pdf(m, -1e-300) == 0);
        CHECK(std::isnan(bspline_pdf(m, nan)));
        CHECK(std::isnan(bspline_cdf(m, nan)));
        CHECK(std::isnan(bspline_survival(m, nan)));
        CHECK(std::isnan(bspline_inverse_cdf(m, nan)));
        CHECK(std::isnan(bspline_inverse_tail(m, nan)));
    }
}
