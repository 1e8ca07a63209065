#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "src/render/render.h"
#include "tests/render/image_functions.h"
#include "tests/support/estimators.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::render;
using namespace strata::render::testing;
using scene::EstimatorKind;

namespace {

constexpr double kFrameTime_s = 0.08;
constexpr double kOpen_s = 0.033;

struct Statistics {
    double mean_error = 0;
    double standard_error = 0;  // of the mean
    double rms = 0;
};

// Errors of one pixel against the wave's closed form, over `trials` seeds.
Statistics errors(EstimatorKind kind, int N, int m, int l, const Wave& wave, int trials) {
    const auto image = wave.image();
    const int x = 3;
    const int y = -2;
    const double truth = wave.filtered(x + 0.5, y + 0.5, kFrameTime_s + 0.5 * kOpen_s, m, l, kOpen_s);
    double sum = 0;
    double squares = 0;
    RenderOptions options;
    options.threads = 1;
    for (int seed = 0; seed < trials; ++seed) {
        const Estimator estimator({kind, N, m, l, static_cast<std::uint64_t>(seed), {kFrameTime_s, kOpen_s}});
        const RenderResult result = render::render(image, estimator, {x, y, x + 1, y + 1}, options);
        const double error = static_cast<double>(result.film.at(x, y).x) - truth;
        sum += error;
        squares += error * error;
    }
    const double mean = sum / trials;
    const double variance = (squares - trials * mean * mean) / (trials - 1);
    return {mean, std::sqrt(variance / trials), std::sqrt(squares / trials)};
}

}  // namespace

TEST_CASE("estimators by density are unbiased in space and time: z-test against the closed form") {
    const Wave wave{0.13, -0.21, 9.0};
    for (const EstimatorKind kind : {EstimatorKind::stratified, EstimatorKind::random, EstimatorKind::sobol}) {
        for (const int m : {1, 4, 5}) {
            for (const int N : {1, 3, 4}) {
                const int l = m == 4 ? 3 : 1;
                const Statistics s = errors(kind, N, m, l, wave, 400);
                const double z = s.mean_error / s.standard_error;
                INFO("estimator ", static_cast<int>(kind), " N ", N, " m ", m, " z ", z);
                CHECK(std::fabs(z) < 4);
                CHECK(s.standard_error < 0.05);
            }
        }
    }
}

TEST_CASE("weighted estimators come nearer to the closed form as N grows") {
    const Wave wave{0.1, 0.07, 0.0};
    for (const EstimatorKind kind :
         {EstimatorKind::uniform, EstimatorKind::jittered, EstimatorKind::shared, EstimatorKind::shared_sobol}) {
        for (const int m : {2, 4, 5}) {
            const Statistics coarse = errors(kind, 4, m, 1, wave, 40);
            const Statistics fine = errors(kind, 16, m, 1, wave, 40);
            INFO("estimator ", static_cast<int>(kind), " m ", m, " rms ", coarse.rms, " -> ", fine.rms);
            CHECK(fine.rms < 0.01);
            CHECK(fine.rms < 0.5 * coarse.rms + 1e-6);
        }
    }
}

TEST_CASE("super-sampling approaches the box filter whatever the order") {
    const Wave wave{0.3, 0.2, 0.0};
    const Statistics s = errors(EstimatorKind::super, 64, 1, 1, wave, 2);
    CHECK(std::fabs(s.mean_error) < 1e-4);
    const auto image = wave.image();
    const Rect pixel{0, 0, 1, 1};
    const Estimator box({EstimatorKind::super, 5, 1, 1, 1, {}});
    const Estimator high({EstimatorKind::super, 5, 9, 1, 1, {}});
    CHECK(render::render(image, box, pixel).film.at(0, 0) == render::render(image, high, pixel).film.at(0, 0));
}

TEST_CASE("a ramp is reproduced: exactly by symmetric grids, within its statistics by the others") {
    const auto image = ramp();
    const int side = 24;
    for (const EstimatorKind kind : support::kAllEstimators) {
        for (const int m : {1, 4, 5}) {
            const int N = 4;
            const RenderResult result =
                render::render(image, Estimator({kind, N, m, 1, 3, {}}), Rect{0, 0, side, side});
            double sum = 0;
            double squares = 0;
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    const double error = static_cast<double>(result.film.at(x, y).x) - (x + 0.5);
                    sum += error;
                    squares += error * error;
                }
            }
            const double n = side * side;
            const double sigma_one = std::sqrt(m / 12.0);
            INFO("estimator ", static_cast<int>(kind), " m ", m, " mean ", sum / n, " rms ", std::sqrt(squares / n));
            if (kind == EstimatorKind::none || kind == EstimatorKind::super || kind == EstimatorKind::uniform) {
                CHECK(std::sqrt(squares / n) < 2e-6);
            } else {
                // No estimator is worse than N^2 independent samples, but for weights (2), by their ratio.
                const double worst = sigma_one / N * (kind == EstimatorKind::jittered ? 2 : 1.1);
                CHECK(std::sqrt(squares / n) < worst);
                CHECK(std::fabs(sum / n) < 4 * worst / side + (kind == EstimatorKind::jittered ? 0.02 : 0.0));
            }
        }
    }
}

TEST_CASE("sharing and Sobol points lower the error as measured for the method") {
    const Wave wave{0.11, 0.17, 0.0};
    const double stratified = errors(EstimatorKind::stratified, 4, 4, 1, wave, 300).rms;
    const double random = errors(EstimatorKind::random, 4, 4, 1, wave, 300).rms;
    const double sobol = errors(EstimatorKind::sobol, 4, 4, 1, wave, 300).rms;
    const double shared = errors(EstimatorKind::shared, 4, 4, 1, wave, 300).rms;
    const double shared_sobol = errors(EstimatorKind::shared_sobol, 4, 4, 1, wave, 300).rms;
    MESSAGE("rms relative to stratified: random ", random / stratified, ", sobol ", sobol / stratified, ", shared ",
            shared / stratified, ", shared_sobol ", shared_sobol / stratified);
    CHECK(random > 1.3 * stratified);
    CHECK(sobol < 1.1 * stratified);
    CHECK(shared < 0.6 * stratified);
    CHECK(shared_sobol < 0.6 * stratified);
}
