#include "src/filter/bspline_paper.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "src/filter/bspline.h"

using namespace strata::filter;

TEST_CASE("the paper's recursion gives the same density and distribution") {
    std::mt19937_64 random(1);
    for (int m = 1; m <= 12; ++m) {
        std::uniform_real_distribution<double> around(-1.0, m + 1.0);
        for (int i = 0; i < 40; ++i) {
            const double x = around(random);
            CAPTURE(m);
            CAPTURE(x);
            CHECK(std::abs(paper::cdf(m, x) - bspline_cdf(m, x)) <= 1e-14);
            CHECK(std::abs(paper::pdf(m, x) - bspline_pdf(m, x)) <= 1e-14);
        }
    }
}

TEST_CASE("where the paper's iteration converges it finds the exact inverse to a few tolerances") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    double worst = 0;
    for (int m = 1; m <= 9; ++m) {
        // Left at a step of the tolerance, a linear iteration of rate (m-1)/m is m-1 such steps from the root.
        const double bound = std::max(1, m - 1) * paper::kTolerance;
        for (int i = 0; i < 60; ++i) {
            const double y = i % 2 == 0 ? uniform(random) : std::pow(10.0, -14 * uniform(random));
            const paper::PaperInversion inversion = paper::inverse_cdf(m, y);
            CAPTURE(m);
            CAPTURE(y);
            REQUIRE(inversion.converged);
            const double error = std::abs(inversion.x - bspline_inverse_cdf(m, y));
            REQUIRE(error <= bound);
            worst = std::max(worst, error / bound);
        }
    }
    MESSAGE("max observed / bound: " << worst);
}

TEST_CASE("the paper's iteration needs more than the eight steps it reports in the tail, ours does not") {
    const double y = 1e-12;
    const paper::PaperInversion inversion = paper::inverse_cdf(4, y);
    CHECK(inversion.converged);
    CHECK(inversion.iterations > 20);
    CHECK(bspline_invert(4, y).iterations <= 3);
    MESSAGE("m = 4, y = 1e-12: " << inversion.iterations << " iterations");

    CHECK(std::abs(paper::inverse_cdf(4, 1e-8, paper::kTolerance, 8).x - bspline_inverse_cdf(4, 1e-8)) > 0.05);
    CHECK_FALSE(paper::inverse_cdf(4, 1e-8, paper::kTolerance, 8).converged);
}

TEST_CASE("the fast form of the paper's iteration takes the same steps") {
    for (int m : {1, 2, 4, 8, 12}) {
        for (double y : {1e-12, 1e-6, 0.01, 0.3, 0.5, 0.7, 0.99}) {
            const paper::PaperInversion plain = paper::inverse_cdf(m, y);
            const paper::PaperInversion fast = paper::inverse_cdf_fast(m, y);
            CAPTURE(m);
            CAPTURE(y);
            CHECK(plain.converged == fast.converged);
            CHECK(plain.iterations == fast.iterations);
            CHECK(std::abs(plain.x - fast.x) <= 1e-9);
        }
    }
}

TEST_CASE("a failed iteration says so and returns a finite iterate") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int m : {1, 2, 4, 9}) {
        for (double y : {-1.0, 0.0, 1e-300, 1 - 0x1p-53, 1.0, 2.0, nan}) {
            CAPTURE(m);
            CAPTURE(y);
            const paper::PaperInversion inversion = paper::inverse_cdf(m, y);
            CHECK(std::isfinite(inversion.x));
            CHECK(inversion.iterations <= paper::kMaxIterations);
            if (!(y >= 0 && y <= 1)) CHECK_FALSE(inversion.converged);
        }
    }
    CHECK_FALSE(paper::inverse_cdf(1, 1.0).converged);
}
