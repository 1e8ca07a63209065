#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tools/converge/budget.h"
#include "tools/converge/power_law.h"
#include "tools/converge/statistics.h"
#include "tools/report/statistics.h"

using namespace strata::tools::converge;
using namespace strata::tools::report;

namespace {

constexpr int kWidth = 12;
constexpr int kHeight = 10;
constexpr std::size_t kPixels = 120;

// Errors of `seeds` renders whose pixels have noise of their own size, skewed or not, and a bias.
PixelErrors synthetic(std::mt19937& random, int seeds, bool skewed, double even_bias, double odd_bias) {
    std::normal_distribution<double> normal;
    std::exponential_distribution<double> exponential;
    PixelErrors errors(kWidth, kHeight);
    std::vector<double> error(kPixels);
    for (int seed = 0; seed < seeds; ++seed) {
        for (std::size_t i = 0; i < kPixels; ++i) {
            const double noise = skewed ? exponential(random) - 1 : normal(random);
            error[i] = noise * (1 + static_cast<double>(i % 7)) + (i % 2 == 0 ? even_bias : odd_bias);
        }
        errors.add(error);
    }
    return errors;
}

// How often either test fails an estimator, of `trials`.
struct Failures {
    int of_mean = 0, of_squares = 0, of_either = 0;
};

Failures failures(int trials, int seeds, bool skewed, double even_bias, double odd_bias, double level) {
    std::mt19937 random(11);
    const double mean_threshold = sidak_threshold(level, 2, true);
    const double squares_threshold = sidak_threshold(level, 2, false);
    Failures failed;
    for (int trial = 0; trial < trials; ++trial) {
        const PixelErrors errors = synthetic(random, seeds, skewed, even_bias, odd_bias);
        const bool mean = std::fabs(errors.z_of_mean(0)) > mean_threshold;
        const bool squares = errors.z_of_squares(0) > squares_threshold;
        failed.of_mean += mean;
        failed.of_squares += squares;
        failed.of_either += mean || squares;
    }
    return failed;
}

}  // namespace

TEST_CASE("the tests of bias fail an unbiased estimator no more often than stated") {
    constexpr int kTrials = 2000;
    for (const int seeds : {4, 16}) {
        for (const bool skewed : {false, true}) {
            const Failures failed = failures(kTrials, seeds, skewed, 0, 0, 0.05);
            MESSAGE(seeds, " seeds, ", skewed ? "skewed" : "normal", ": failed in the mean ", failed.of_mean,
                    ", in the squares ", failed.of_squares, ", in either ", failed.of_either, " of 2000");
            // 100 expected, 9.7 their standard deviation; estimated variances and skewness are worth some more.
            CHECK(failed.of_either <= 150);
            CHECK(failed.of_mean >= 20);
        }
    }
}

TEST_CASE("a planted bias is found, also one that cancels over pixels") {
    const Failures even = failures(200, 16, false, 0.5, 0.5, 0.01);
    CHECK(even.of_mean >= 195);
    const Failures cancelling = failures(200, 16, false, 2, -2, 0.01);
    MESSAGE("a cancelling bias was found in the mean ", cancelling.of_mean, ", in the squares ", cancelling.of_squares,
            " times of 200");
    CHECK(cancelling.of_mean <= 12);
    CHECK(cancelling.of_squares >= 195);
}

TEST_CASE("a truth that is only known so well fails nobody") {
    std::mt19937 random(5);
    const PixelErrors errors = synthetic(random, 16, false, 0.5, 0.5);
    CHECK(std::fabs(errors.z_of_mean(0.5)) < 2);
    PixelErrors exact(2, 2);
    exact.add(std::array<double, 4>{});
    exact.add(std::array<double, 4>{});
    CHECK(exact.z_of_mean(0) == 0);
    CHECK(exact.z_of_squares(0) == 0);
}

TEST_CASE("the squared bias is free of noise") {
    std::mt19937 random(6);
    double sum = 0;
    constexpr int kTrials = 400;
    for (int trial = 0; trial < kTrials; ++trial) sum += synthetic(random, 4, true, 3, -1).squared_bias().mean;
    CHECK(sum / kTrials == doctest::Approx(5.0).epsilon(0.05));
}

TEST_CASE("correlation of neighbours: none, all, opposite, and that of a moving average") {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    PixelErrors white(64, 48), same(64, 48), opposite(64, 48), smooth(64, 48);
    for (int seed = 0; seed < 6; ++seed) {
        std::vector<double> noise(65 * 49), error(64 * 48), even(64 * 48), chequered(64 * 48), averaged(64 * 48);
        for (double& value : noise) value = normal(random);
        const double common = normal(random);
        for (std::size_t y = 0; y < 48; ++y) {
            for (std::size_t x = 0; x < 64; ++x) {
                const std::size_t i = y * 64 + x;
                error[i] = noise[y * 65 + x];
                even[i] = common;
                chequered[i] = (x + y) % 2 == 0 ? common : -common;
                averaged[i] =
                    noise[y * 65 + x] + noise[y * 65 + x + 1] + noise[(y + 1) * 65 + x] + noise[(y + 1) * 65 + x + 1];
            }
        }
        white.add(error);
        same.add(even);
        opposite.add(chequered);
        smooth.add(averaged);
    }
    CHECK(std::fabs(white.neighbour_correlation()) < 0.02);
    CHECK(same.neighbour_correlation() == doctest::Approx(1.0));
    CHECK(opposite.neighbour_correlation() == doctest::Approx(-1.0));
    CHECK(smooth.neighbour_correlation() == doctest::Approx(0.5).epsilon(0.05));
}

TEST_CASE("the interval of an error over seeds holds the truth 95 % of the time") {
    std::mt19937 random(9);
    std::normal_distribution<double> normal;
    for (const int seeds : {4, 16}) {
        int held = 0;
        constexpr int kTrials = 2000;
        for (int trial = 0; trial < kTrials; ++trial) {
            std::vector<double> squares;
            for (int seed = 0; seed < seeds; ++seed) {
                double sum = 0;
                for (int pixel = 0; pixel < 100; ++pixel) sum += std::pow(0.3 * normal(random), 2);
                squares.push_back(sum / 100);
            }
            const RootMean rmse = root_mean(squares);
            held += std::fabs(rmse.value - 0.3) <= rmse.half_width;
        }
        MESSAGE(seeds, " seeds: ", held, " of 2000 intervals held the truth");
        CHECK(held >= 1860);
        CHECK(held <= 1940);
    }
    CHECK(std::isinf(root_mean(std::array<double, 1>{0.04}).half_width));
    CHECK(root_mean(std::array<double, 1>{0.04}, true).half_width == 0);
}

TEST_CASE("a fitted slope is the data's, and its interval holds it 95 % of the time") {
    std::mt19937 random(10);
    std::normal_distribution<double> normal;
    int held = 0;
    constexpr int kTrials = 2000;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> x, y, ci;
        for (const double N : {2, 4, 8, 16, 32}) {
            x.push_back(N * N);
            y.push_back(0.7 * std::pow(N * N, -0.75) * std::exp(0.05 * normal(random)));
            ci.push_back(0);
        }
        const auto law = fit_power_law(x, y, ci);
        REQUIRE(law);
        held += std::fabs(law->slope + 0.75) <= law->slope_ci;
    }
    MESSAGE(held, " of 2000 intervals held the slope");
    CHECK(held >= 1870);
    CHECK(held <= 1930);

    const std::vector<double> x{1, 10, 100}, y{5, 0.5, 0.05}, ci{0.1, 0.1, 0.1};
    const auto exact = fit_power_law(x, y, ci);
    REQUIRE(exact);
    CHECK(exact->slope == doctest::Approx(-1.0));
    CHECK(exact->at(1000) == doctest::Approx(0.005));
    // Without scatter, what the points themselves leave open: 0.1 / ln 10 * sqrt 2 / 2.
    CHECK(exact->slope_ci == doctest::Approx(0.1 / std::log(10.0) / std::sqrt(2.0)));
    CHECK(!fit_power_law(std::span(x).first(2), std::span(y).first(2), std::span(ci).first(2)));
    CHECK(!fit_power_law(std::array{2.0, 2.0, 2.0}, y, ci));
}

TEST_CASE("the time to an error: between points, beyond them and before them") {
    const std::vector<double> seconds{1, 4, 16}, errors{0.8, 0.2, 0.05};
    const std::vector<double> ci(3, 0.0);
    const auto law = fit_power_law(seconds, errors, ci);
    const auto between = time_to_error(0.1, seconds, errors, law);
    REQUIRE(between);
    CHECK(between->seconds == doctest::Approx(8.0));
    CHECK(between->reach == Reach::interpolated);
    const auto beyond = time_to_error(0.0125, seconds, errors, law);
    REQUIRE(beyond);
    CHECK(beyond->seconds == doctest::Approx(64.0));
    CHECK(beyond->reach == Reach::extrapolated);
    const auto before = time_to_error(0.9, seconds, errors, law);
    REQUIRE(before);
    CHECK(before->seconds == 1.0);
    CHECK(before->reach == Reach::at_first);
    CHECK(!time_to_error(0.01, seconds, errors, std::nullopt));
    CHECK(!time_to_error(0.01, seconds, errors, PowerLaw{0.1, 0, 0, 3}));
    CHECK(!time_to_error(0.01, {}, {}, law));
}

TEST_CASE("a budget takes the largest N that leaves enough seeds, then as many seeds as fit") {
    const auto cost = [](int N) { return 0.01 * N * N; };
    const auto fixed = [](int N) { return 0.1 * N; };
    const std::vector<int> all{1, 2, 4, 8, 16, 32};
    const auto rich = plan_budget(all, 16, 1e6, cost, fixed);
    REQUIRE(rich);
    CHECK(rich->Ns == all);
    CHECK(rich->seeds == 16);
    for (const double seconds : {1.0, 3.0, 10.0, 30.0, 100.0}) {
        const auto plan = plan_budget(all, 16, seconds, cost, fixed);
        REQUIRE(plan);
        CHECK(plan->predicted_s <= seconds);
        CHECK(plan->seeds >= (plan->Ns.size() == 1 ? 2 : kLeastSeeds));
        if (plan->Ns.size() == all.size()) continue;
        const int next = all[plan->Ns.size()];
        double more = fixed(next) + kLeastSeeds * cost(next);
        for (const int N : plan->Ns) more += kLeastSeeds * cost(N);
        CHECK(more > seconds);
    }
    CHECK(!plan_budget(all, 16, 0.1, cost, fixed));
    CHECK(plan_budget(all, 1, 0.12, cost, fixed)->seeds == 1);
}

TEST_CASE("Sidak's threshold is the single test's for one test, and grows with their number") {
    CHECK(sidak_threshold(0.05, 1, true) == doctest::Approx(1.959964));
    CHECK(sidak_threshold(0.05, 1, false) == doctest::Approx(1.644854));
    CHECK(sidak_threshold(0.01, 100, true) > 3.8);
    CHECK(sidak_threshold(0.01, 100, true) < 4.0);
}

TEST_CASE("median and quartiles") {
    const Spread spread = spread_of({5, 1, 3, 2, 4});
    CHECK(spread.median == 3);
    CHECK(spread.low_quartile == 2);
    CHECK(spread.high_quartile == 4);
    CHECK(spread_of({7}).high_quartile == 7);
    CHECK(spread_of({}).median == 0);
}
