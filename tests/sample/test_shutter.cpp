#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/filter/bspline_table.h"
#include "src/sample/counter_hash.h"
#include "src/sample/shutter.h"
#include "src/sample/strata.h"
#include "tests/sample/unfold.h"

using namespace strata::sample;
using strata::sample::test::unfold;

TEST_CASE("every pixel has one sample in each of its N^2 strata of time") {
    for (const std::size_t n : {std::size_t{1}, std::size_t{4}, std::size_t{9}, std::size_t{100}, std::size_t{4096}}) {
        std::vector<std::uint32_t> scratch(n);
        std::vector<float> q(n);
        for (int pixel = 0; pixel < 20; ++pixel) {
            folded_times(cell_key(4, pixel, -pixel), scratch, q);
            std::vector<double> y;
            for (const float folded : q) y.push_back(unfold(folded));
            std::sort(y.begin(), y.end());
            for (std::size_t i = 0; i < n; ++i) {
                REQUIRE(y[i] * static_cast<double>(n) >= static_cast<double>(i) - 1e-3);
                REQUIRE(y[i] * static_cast<double>(n) <= static_cast<double>(i) + 1 + 1e-3);
            }
        }
    }
}

TEST_CASE("random times leave the share of strata empty that independent ones leave") {
    const std::size_t n = 64;
    std::vector<float> q(n);
    std::size_t empty = 0;
    const int pixels = 4000;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        folded_random_times(cell_key(4, pixel, 3), q);
        std::vector<int> count(n);
        for (const float folded : q) ++count[std::min(n - 1, static_cast<std::size_t>(unfold(folded) * n))];
        empty += static_cast<std::size_t>(std::count(count.begin(), count.end(), 0));
    }
    // n balls in n urns: each urn is empty with p = (1 - 1/n)^n; the variance of a pixel's count is below n p.
    const double p = std::pow(1.0 - 1.0 / n, n);
    const double z = (static_cast<double>(empty) - pixels * n * p) / std::sqrt(pixels * n * p);
    MESSAGE("empty strata: ", z, " of a sigma's upper bound");
    CHECK(std::fabs(z) < 4);
}

TEST_CASE("times are uncorrelated with sample indices over pixels") {
    const std::size_t n = 16;
    std::vector<std::uint32_t> scratch(n);
    std::vector<float> q(n);
    double sum = 0;
    const int pixels = 20000;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        folded_times(cell_key(4, pixel, 3), scratch, q);
        for (std::size_t i = 0; i < n; ++i) sum += (static_cast<double>(i) - 7.5) * (unfold(q[i]) - 0.5);
    }
    // Per pixel the variance is that of a random permutation: sum (i - mean)^2 times var(y) n / (n - 1).
    const double variance = 340.0 * (1.0 / 12) * 16 / 15;
    const double z = sum / std::sqrt(pixels * variance);
    MESSAGE("correlation of index and time: ", z, " sigma");
    CHECK(std::fabs(z) < 4);
}

TEST_CASE("order 1 fills the open shutter exactly, order l has support l s about its middle") {
    const Shutter shutter{0.4, 0.033};
    CHECK(shutter.middle_s() == doctest::Approx(0.4165));
    for (const int order : {1, 4}) {
        const strata::filter::BsplineTable table(order);
        const std::size_t n = 4096;
        std::vector<std::uint32_t> scratch(n);
        std::vector<float> q(n);
        double lowest = 1e9;
        double highest = -1e9;
        for (int pixel = 0; pixel < 50; ++pixel) {
            folded_times(cell_key(1, pixel, 0), scratch, q);
            for (const float folded : q) {
                const double t = shutter.time_s(static_cast<double>(table.centred(folded)));
                lowest = std::min(lowest, t);
                highest = std::max(highest, t);
            }
        }
        const double half = 0.5 * order * shutter.open_s;
        CHECK(lowest >= shutter.middle_s() - half);
        CHECK(highest <= shutter.middle_s() + half);
        if (order == 1) CHECK(highest - lowest > 0.9999 * shutter.open_s);
    }
}
