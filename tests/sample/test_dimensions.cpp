#include "src/sample/dimensions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <vector>

using namespace strata::sample;

TEST_CASE("an order has every place once, for any count and key") {
    for (std::uint32_t n : {1u, 2u, 3u, 4u, 5u, 9u, 16u, 25u, 63u, 64u, 65u, 1000u, 4096u}) {
        for (std::uint64_t key = 0; key < 50; ++key) {
            std::vector<int> seen(n, 0);
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t place = place_in_order(i, n, strata::noise::mix64(key));
                REQUIRE(place < n);
                ++seen[place];
            }
            CHECK(std::ranges::count(seen, 1) == static_cast<std::ptrdiff_t>(n));
        }
    }
}

// Chi-squared of n cells against even: mean n - 1, standard deviation sqrt(2 (n - 1)); 6 of these are allowed.
TEST_CASE("every index comes to every place equally often") {
    for (const std::uint32_t n : {2u, 4u, 9u, 16u}) {
        constexpr int kKeys = 20000;
        for (std::uint32_t i = 0; i < n; ++i) {
            std::vector<double> count(n, 0.0);
            for (int key = 0; key < kKeys; ++key)
                ++count[place_in_order(i, n, strata::noise::mix64(static_cast<std::uint64_t>(key)))];
            double chi2 = 0.0;
            const double even = static_cast<double>(kKeys) / n;
            for (const double c : count) chi2 += (c - even) * (c - even) / even;
            CHECK(chi2 < (n - 1) + 6.0 * std::sqrt(2.0 * (n - 1)));
        }
        // The first two indices come to every pair of places, too.
        std::vector<double> pairs(n * n, 0.0);
        for (int k = 0; k < 20 * kKeys; ++k) {
            const std::uint64_t key = strata::noise::mix64(static_cast<std::uint64_t>(k) + 77);
            ++pairs[place_in_order(0, n, key) * n + place_in_order(1, n, key)];
        }
        const double cells = n * (n - 1.0), even = 20.0 * kKeys / cells;
        double chi2 = 0.0;
        for (std::uint32_t cell = 0; cell < n * n; ++cell) {
            if (cell / n != cell % n) chi2 += (pairs[cell] - even) * (pairs[cell] - even) / even;
        }
        CHECK(chi2 < (cells - 1) + 6.0 * std::sqrt(2.0 * (cells - 1)));
    }
}

TEST_CASE(
    "the samples of one owner are a net in each pair: one point in each of n boxes of every shape, n a power of 2") {
    for (const std::uint32_t n : {1u, 4u, 16u, 64u, 256u}) {
        const int k = std::countr_zero(n);
        for (std::uint32_t pair = 0; pair < 6; ++pair) {
            for (int a = 0; a <= k; ++a) {
                std::set<std::pair<int, int>> boxes;
                for (std::uint32_t i = 0; i < n; ++i) {
                    const auto [u, v] = dimension_pair({77, i, n}, pair);
                    REQUIRE(u > 0.0);
                    REQUIRE(u < 1.0);
                    REQUIRE(v > 0.0);
                    REQUIRE(v < 1.0);
                    boxes.insert({static_cast<int>(std::ldexp(u, a)), static_cast<int>(std::ldexp(v, k - a))});
                }
                CHECK(boxes.size() == n);
            }
        }
    }
}

// Correlation of n independent numbers has the standard deviation 1 / sqrt(n); 5 of these are allowed.
TEST_CASE("pairs of one sample, and the same pair of neighbouring owners, are not correlated") {
    constexpr int kOwners = 40000;
    std::map<const char*, double> sums;
    for (int k = 0; k < kOwners; ++k) {
        const std::uint64_t key = cell_key(1, k % 200, k / 200);
        const SampleId id{key, 3, 16}, right{cell_key(1, k % 200 + 1, k / 200), 3, 16};
        const auto [a, b] = dimension_pair(id, 0);
        const auto [c, d] = dimension_pair(id, 1);
        const auto [e, f] = dimension_pair(right, 0);
        sums["a b"] += 12 * (a - 0.5) * (b - 0.5);
        sums["a c"] += 12 * (a - 0.5) * (c - 0.5);
        sums["b d"] += 12 * (b - 0.5) * (d - 0.5);
        sums["a e"] += 12 * (a - 0.5) * (e - 0.5);
        sums["b f"] += 12 * (b - 0.5) * (f - 0.5);
    }
    for (const auto& [what, sum] : sums) {
        CAPTURE(what);
        CHECK(std::abs(sum) < 5.0 * std::sqrt(static_cast<double>(kOwners)));
    }
}

// The classic test of padded dimensions: f = product over four dimensions. Independent points would have the variance
// of one over n; nets in each pair leave only what the pairs have in common.
TEST_CASE("the mean of a smooth function of two pairs converges faster than with independent numbers, unbiased") {
    const auto f = [](double a, double b, double c, double d) { return a * b + std::sin(3.0 * c) * d + 0.1 * a * c; };
    const double expected = 0.25 + (1.0 - std::cos(3.0)) / 3.0 * 0.5 + 0.025;
    constexpr std::uint32_t n = 64;
    constexpr int kOwners = 4000;
    double sum = 0.0, sum2 = 0.0, one2 = 0.0;
    for (int k = 0; k < kOwners; ++k) {
        double mean = 0.0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const SampleId id{cell_key(5, k, 0), i, n};
            const auto [a, b] = dimension_pair(id, 0);
            const auto [c, d] = dimension_pair(id, 1);
            const double value = f(a, b, c, d);
            mean += value / n;
            if (i == 0) one2 += (value - expected) * (value - expected);
        }
        sum += mean - expected;
        sum2 += (mean - expected) * (mean - expected);
    }
    const double deviation = std::sqrt(sum2 / kOwners), independent = std::sqrt(one2 / kOwners / n);
    CHECK(std::abs(sum / kOwners) < 4.0 * deviation / std::sqrt(kOwners));
    CHECK(deviation < 0.3 * independent);
    MESSAGE("deviation over that of independent numbers: ", deviation / independent);
}
