#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "src/sample/counter_hash.h"
#include "src/sample/pattern.h"
#include "src/sample/strata.h"
#include "tests/sample/unfold.h"

using namespace strata::sample;
using strata::sample::test::unfold;

namespace {

// sqrt(n) times the greatest distance of the empirical distribution from the uniform one.
double kolmogorov_smirnov(std::vector<double> y) {
    std::sort(y.begin(), y.end());
    const double n = static_cast<double>(y.size());
    double distance = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        distance = std::max({distance, y[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - y[i]});
    }
    return distance * std::sqrt(n);
}

constexpr double kKsBound = 1.95;  // exceeded by one in a thousand

}  // namespace

TEST_CASE("folding a stratum keeps the relative precision of both tails and never exceeds one half") {
    std::mt19937 engine(1);
    const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
    double worst = 0;
    for (int trial = 0; trial < 200000; ++trial) {
        const std::uint32_t n = 1 + random() % (trial % 2 == 0 ? 8 : 4096);
        const std::uint32_t i = trial % 3 == 0 ? 0 : trial % 3 == 1 ? n - 1 : random() % n;
        const std::uint32_t word = trial % 5 == 0 ? random() >> (random() % 32) : ~(random() >> (random() % 32));
        const float q = folded_stratum(i, n, word);
        // In exact integers: y = (i 2^33 + 2 word + 1) / (n 2^33).
        const auto whole = static_cast<unsigned __int128>(n) << 33;
        const auto y = (static_cast<unsigned __int128>(i) << 33) + 2 * static_cast<unsigned __int128>(word) + 1;
        const bool lower = 2 * y < whole;
        const double p = static_cast<double>(lower ? y : whole - y) / static_cast<double>(whole);
        REQUIRE(std::signbit(q) == lower);
        REQUIRE(std::fabs(q) <= 0.5f);
        REQUIRE(std::fabs(q) > 0);
        worst = std::max(worst, std::fabs(static_cast<double>(std::fabs(q)) - p) / p);
    }
    const double bound = 4 * 0x1p-24;  // four float roundings
    MESSAGE("relative error of folded probabilities: ", worst / bound, " of its bound");
    CHECK(worst <= bound);
}

TEST_CASE("positions in strata stay in [0,1) and in their stratum") {
    double worst = 0;
    for (const std::uint32_t n : {1u, 2u, 3u, 7u, 64u, 1000u}) {
        for (std::uint32_t i = 0; i < n; ++i) {
            for (const std::uint32_t word : {0u, 1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
                const float x = stratum(i, n, word);
                REQUIRE(x >= 0.0f);
                REQUIRE(x < 1.0f);
                const double inside = static_cast<double>(x) * n - i;
                worst = std::max({worst, -inside, inside - 1});
            }
        }
    }
    MESSAGE("strays from its stratum by at most ", worst, " strata");
    CHECK(worst <= 1000 * 0x1p-23);
}

TEST_CASE("keys of neighbouring, distant and negative cells and of close seeds differ") {
    std::set<std::uint64_t> keys;
    std::size_t count = 0;
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
        for (std::int64_t y = -60; y < 60; ++y) {
            for (std::int64_t x = -60; x < 60; ++x, ++count) keys.insert(cell_key(seed, x, y));
        }
    }
    CHECK(keys.size() == count);
}

TEST_CASE("first numbers of neighbouring cells are uniform and uncorrelated") {
    std::vector<double> numbers;
    double right = 0;
    double below = 0;
    const int side = 200;
    const auto number = [](int x, int y) {
        const std::uint64_t key = stream_key(cell_key(1, x - 100, y - 100), Stream::space);
        return static_cast<double>(unit_float(high_word(counter_hash(key, 0))));
    };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            numbers.push_back(number(x, y));
            right += (number(x, y) - 0.5) * (number(x + 1, y) - 0.5);
            below += (number(x, y) - 0.5) * (number(x, y + 1) - 0.5);
        }
    }
    CHECK(kolmogorov_smirnov(numbers) < kKsBound);
    // A product of two independent numbers about their mean has standard deviation 1/12; there are side^2 of them.
    const double sigma = side / 12.0;
    MESSAGE("correlation of neighbours: ", right / sigma, " and ", below / sigma, " sigma");
    CHECK(std::fabs(right) < 4 * sigma);
    CHECK(std::fabs(below) < 4 * sigma);
}

TEST_CASE("the stratified pattern has one sample in every cell, uniformly within it") {
    for (const int N : {1, 2, 3, 4, 10}) {
        const Pattern pattern(PatternKind::stratified, N);
        std::vector<float> u(static_cast<std::size_t>(N * N));
        std::vector<float> v(u.size());
        std::vector<double> jitter_u;
        std::vector<double> jitter_v;
        for (int x = 0; static_cast<int>(jitter_u.size()) < 20000; ++x) {
            pattern.folded(cell_key(7, x, -x), u, v);
            for (int i = 0; i < N * N; ++i) {
                jitter_u.push_back(unfold(u[i]) * N - i % N);
                jitter_v.push_back(unfold(v[i]) * N - i / N);
                REQUIRE(jitter_u.back() >= -1e-5);
                REQUIRE(jitter_u.back() <= 1 + 1e-5);
                REQUIRE(jitter_v.back() >= -1e-5);
                REQUIRE(jitter_v.back() <= 1 + 1e-5);
            }
        }
        CHECK(kolmogorov_smirnov(jitter_u) < kKsBound);
        CHECK(kolmogorov_smirnov(jitter_v) < kKsBound);
    }
}
