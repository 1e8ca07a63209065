#include "src/render/progressive.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "src/sample/counter_hash.h"
#include "tests/render/image_functions.h"
#include "tests/support/estimators.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::parallel;
using namespace strata::render;
using namespace strata::render::testing;
using scene::EstimatorKind;

namespace {

// Those whose passes differ.
const std::vector<EstimatorKind> kRandomised =
    support::estimators_where([](const scene::EstimatorRow& row) { return !row.is_grid(); });

EstimatorSettings settings(EstimatorKind kind, int N = 2, std::uint64_t seed = 1) {
    return {kind, N, 4, 1, seed, {0.04, 0.01}};
}

ProgressiveResult progressive(const ImageFunction& image, const EstimatorSettings& s, const Rect& window,
                              const PassGoal& goal, int threads = 1) {
    RenderOptions options;
    options.threads = threads;
    return render_progressively(image, s, window, goal, options);
}

// Cancels itself when it has evaluated so many samples.
class SelfCancelling final : public ImageFunction {
  public:
    SelfCancelling(CancelToken& token, std::uint64_t after) : token_(token), after_(after) {}

    void evaluate(const SampleBatch& samples, const SampleOut& out, Counters& counters) const override {
        inner_.evaluate(samples, out, counters);
        if ((evaluated_ += samples.u.size()) >= after_) token_.request();
    }

  private:
    CancelToken& token_;
    std::uint64_t after_;
    mutable std::atomic<std::uint64_t> evaluated_{0};
    decltype(busy()) inner_ = busy();
};

double rmse(const Film& film, const Film& truth) {
    double sum = 0;
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        const glm::dvec3 error = glm::dvec3(film.pixels()[i]) - glm::dvec3(truth.pixels()[i]);
        sum += glm::dot(error, error);
    }
    return std::sqrt(sum / (3 * static_cast<double>(film.pixels().size())));
}

}  // namespace

TEST_CASE("one pass is the plain render, and so is pass 0 of any seed") {
    const auto image = busy();
    const Rect window{-3, 2, 14, 9};
    for (const EstimatorKind kind : support::kAllEstimators) {
        const ProgressiveResult one = progressive(image, settings(kind), window, {});
        CHECK(one.passes == 1);
        CHECK(!one.error);
        CHECK(one.render.film.pixels() == render::render(image, Estimator(settings(kind)), window).film.pixels());
    }
    CHECK(sample::pass_seed(77, 0) == 77);
}

TEST_CASE("K passes are the mean of K plain renders with the passes' seeds, each counting by its sum of weights") {
    const auto image = busy();
    const Rect window{0, 0, 11, 6};
    for (const EstimatorKind kind : kRandomised) {
        for (const int passes : {2, 3, 6}) {
            std::vector<glm::dvec3> sum(66, glm::dvec3(0));
            std::vector<double> total(66, 0.0);
            RenderOptions options;
            options.with_weights = true;
            for (int p = 0; p < passes; ++p) {
                EstimatorSettings s = settings(kind);
                s.seed = sample::pass_seed(s.seed, static_cast<std::uint64_t>(p));
                const Film plain = render::render(image, Estimator(s), window, options).film;
                for (std::size_t i = 0; i < sum.size(); ++i) {
                    const double weight = plain.weights().empty() ? 1.0 : plain.weights()[i];
                    sum[i] += weight * glm::dvec3(plain.pixels()[i]);
                    total[i] += weight;
                }
            }
            const ProgressiveResult result = progressive(image, settings(kind), window, {.passes = passes});
            CHECK(result.passes == passes);
            CHECK(result.end == PassesEnd::passes);
            CHECK(!result.render.cancelled);
            int wrong = 0;
            for (std::size_t i = 0; i < sum.size(); ++i)
                wrong += result.render.film.pixels()[i] != glm::vec3(sum[i] / total[i]);
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE(
    "what made it stop leaves no trace: by target or time, the same bits as by number; threads, tiles, crops too") {
    const auto image = busy();
    const Rect window{0, 0, 24, 14};
    for (const EstimatorKind kind : {EstimatorKind::stratified, EstimatorKind::shared}) {
        const ProgressiveResult by_target =
            progressive(image, settings(kind), window, {.passes = kMostPasses, .target_rmse = 0.03}, 2);
        CHECK(by_target.end == PassesEnd::target);
        CHECK(by_target.passes >= 4);
        CHECK(by_target.error->high <= 0.03);
        CHECK(by_target.predicted_passes.has_value());
        const PassGoal same{.passes = by_target.passes};
        CHECK(progressive(image, settings(kind), window, same).render.film.pixels() == by_target.render.film.pixels());
        RenderOptions tiles;
        tiles.threads = 2;
        tiles.tile = 5;
        CHECK(render_progressively(image, settings(kind), window, same, tiles).render.film.pixels() ==
              by_target.render.film.pixels());
        const Film crop = progressive(image, settings(kind), {5, 3, 9, 8}, same).render.film;
        int wrong = 0;
        for (int y = 3; y < 8; ++y)
            for (int x = 5; x < 9; ++x) wrong += crop.at(x, y) != by_target.render.film.at(x, y);
        CHECK(wrong == 0);
        const ProgressiveResult by_time =
            progressive(image, settings(kind), window, {.passes = kMostPasses, .time_limit_s = 0.02});
        CHECK(by_time.end == PassesEnd::time);
        CHECK(progressive(image, settings(kind), window, {.passes = by_time.passes}).render.film.pixels() ==
              by_time.render.film.pixels());
    }
}

TEST_CASE("the first pass is done however short the time, and passes bound a target that is out of reach") {
    const auto image = busy();
    const Rect window{0, 0, 8, 8};
    const ProgressiveResult short_time =
        progressive(image, settings(EstimatorKind::random), window, {.passes = kMostPasses, .time_limit_s = 1e-9});
    CHECK(short_time.passes == 1);
    CHECK(short_time.end == PassesEnd::time);
    const ProgressiveResult bounded =
        progressive(image, settings(EstimatorKind::random), window, {.passes = 6, .target_rmse = 1e-6});
    CHECK(bounded.passes == 6);
    CHECK(bounded.end == PassesEnd::passes);
}

TEST_CASE("an error that is no number ends the wait for a target") {
    const auto image = Formula(
        [](double u, double, double) { return glm::vec3(u > 4 ? std::numeric_limits<double>::infinity() : 0.0); });
    const ProgressiveResult result =
        progressive(image, settings(EstimatorKind::random), {0, 0, 8, 8}, {.passes = 100, .target_rmse = 0.1});
    CHECK(result.end == PassesEnd::not_finite);
    CHECK(result.passes == 2);
}

TEST_CASE("passes that would all be alike are refused") {
    const auto image = busy();
    for (const EstimatorKind kind : support::estimators_where(&scene::EstimatorRow::is_grid)) {
        CHECK_THROWS_AS(progressive(image, settings(kind), {0, 0, 2, 2}, {.passes = 2}), std::invalid_argument);
    }
    CHECK_THROWS_AS(progressive(image, settings(EstimatorKind::sobol), {0, 0, 2, 2}, {.passes = 0}),
                    std::invalid_argument);
}

TEST_CASE("an interrupted render keeps its whole passes; interrupted in the first, its finished pixels") {
    const Rect window{0, 0, 32, 32};
    constexpr std::uint64_t kPass = 32 * 32 * 4;
    for (const double passes : {0.4, 2.5, 3.7}) {
        CancelToken token;
        const SelfCancelling image(token, static_cast<std::uint64_t>(passes * kPass));
        RenderOptions options;
        options.threads = 1;
        options.tile = 8;
        options.cancel = &token;
        const ProgressiveResult result =
            render_progressively(image, settings(EstimatorKind::stratified), window, {.passes = 8}, options);
        CHECK(result.end == PassesEnd::cancelled);
        CHECK(result.render.cancelled);
        CHECK(result.passes == static_cast<int>(passes));
        CHECK(result.render.film.complete() == (result.passes > 0));
        if (result.passes == 0) continue;
        const auto plain = busy();
        CHECK(progressive(plain, settings(EstimatorKind::stratified), window, {.passes = result.passes})
                  .render.film.pixels() == result.render.film.pixels());
    }
}

TEST_CASE("the noise told from differences is that against the truth, and its upper end holds 95 % of the time") {
    const Wave wave{0.13, -0.21, 0.0};
    const auto image = wave.image();
    const Rect window{0, 0, 16, 9};
    Film truth(window);
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 16; ++x) {
            const double u = x + 0.5, v = y + 0.5;
            // The sine is the cosine a quarter of a period on.
            truth.finish(x, y, {wave.filtered(u, v, 0, 4, 1, 0), wave.filtered(u - 0.25 / wave.fu, v, 0, 4, 1, 0), 1});
        }
    }
    constexpr int kTrials = 300;
    for (const EstimatorKind kind : {EstimatorKind::stratified, EstimatorKind::random, EstimatorKind::shared_sobol}) {
        for (const int passes : {4, 8}) {
            // Against chance, "the truth" of each trial is the error's root mean square over the trials.
            double squares = 0, estimated = 0;
            std::vector<ErrorEstimate> estimates;
            for (int trial = 0; trial < kTrials; ++trial) {
                EstimatorSettings s = settings(kind, 3, 1000 + static_cast<std::uint64_t>(trial));
                s.shutter = {};
                const ProgressiveResult result = progressive(image, s, window, {.passes = passes});
                squares += std::pow(rmse(result.render.film, truth), 2);
                estimated += std::pow(result.error->rmse, 2);
                estimates.push_back(*result.error);
            }
            const double true_rmse = std::sqrt(squares / kTrials);
            int below_high = 0, above_low = 0;
            for (const ErrorEstimate& e : estimates) {
                below_high += true_rmse <= e.high;
                above_low += true_rmse >= e.low;
            }
            MESSAGE("estimator ", static_cast<int>(kind), ", ", passes, " passes: rmse ", true_rmse, ", told ",
                    std::sqrt(estimated / kTrials), ", below high ", below_high, ", above low ", above_low, " of 300");
            CHECK(std::sqrt(estimated / kTrials) == doctest::Approx(true_rmse).epsilon(0.03));
            // 285 expected; 5 standard deviations of the binomial are 19. Skewness takes a little from the upper end.
            CHECK(below_high >= 264);
            CHECK(above_low >= 264);
        }
    }
}

TEST_CASE("a target is kept: stopping at the first look below it does not favour lucky passes") {
    const auto image = Formula([](double u, double v, double) { return glm::vec3(3 * u + 7 * v > 120 ? 1.0f : 0.0f); });
    const Rect window{4, 4, 20, 13};
    constexpr double kTarget = 0.02;
    EstimatorSettings s = settings(EstimatorKind::stratified, 32);
    s.shutter = {};
    const Film truth = progressive(image, s, window, {.passes = 16}).render.film;
    s.N = 2;
    constexpr int kTrials = 300;
    double squares = 0;
    std::vector<int> passes;
    for (int trial = 0; trial < kTrials; ++trial) {
        s.seed = 100 + static_cast<std::uint64_t>(trial);
        squares += std::pow(rmse(progressive(image, s, window, {}).render.film, truth), 2);
        passes.push_back(progressive(image, s, window, {.passes = kMostPasses, .target_rmse = kTarget}).passes);
    }
    const double needed = squares / kTrials / (kTarget * kTarget);
    int kept = 0;
    double spent = 0;
    for (const int count : passes) {
        kept += count >= needed;
        spent += count;
    }
    MESSAGE(needed, " passes were needed, ", spent / kTrials, " spent; enough in ", kept, " of 300 renders");
    CHECK(kept >= 264);
    CHECK(spent / kTrials < 2 * needed);
}

TEST_CASE("progress tells of all passes and never goes back") {
    const auto image =
        Formula([](double u, double, double) { return glm::vec3(static_cast<float>(std::sin(std::sqrt(u + 40)))); });
    std::vector<double> fractions;
    RenderOptions options;
    options.threads = 1;
    options.on_progress = [&](const Progress& progress) { fractions.push_back(progress.fraction); };
    render_progressively(image, settings(EstimatorKind::random, 8), {0, 0, 160, 90}, {.passes = 5}, options);
    REQUIRE(fractions.size() >= 2);
    for (std::size_t i = 1; i < fractions.size(); ++i) CHECK(fractions[i] >= fractions[i - 1]);
    CHECK(fractions.back() <= 1.0);
    CHECK(fractions.front() < 0.21);
}
