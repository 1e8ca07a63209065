#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "src/estimate/estimator.h"
#include "src/filter/bspline.h"
#include "tests/render/image_functions.h"
#include "tests/support/estimators.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::render::testing;
using scene::EstimatorKind;

namespace {

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

EstimatorSettings settings(EstimatorKind kind, int N, int m, double open_s = 0, int l = 1) {
    return {kind, N, m, l, (std::uint64_t{1} << 40) + 17, {0.4, open_s}};
}

std::vector<glm::ivec2> some_pixels(int count) {
    std::vector<glm::ivec2> pixels;
    for (int i = 0; i < count; ++i) pixels.emplace_back(i % 40 - 5, i / 40 - 5);
    return pixels;
}

void samples_of(const Estimator& estimator, std::span<const glm::ivec2> owners, SampleSet& set) {
    if (estimator.shared()) {
        estimator.cell_samples(owners, set);
    } else {
        estimator.pixel_samples(owners, set);
    }
}

}  // namespace

TEST_CASE("a sample depends on its pixel and index alone: other order, other company, same samples") {
    for (const EstimatorKind kind : support::kAllEstimators) {
        const Estimator estimator(settings(kind, 3, 4, 0.02, 2));
        std::vector<glm::ivec2> pixels = some_pixels(100);
        SampleSet together;
        samples_of(estimator, pixels, together);
        const std::size_t n = static_cast<std::size_t>(estimator.sample_count());
        SampleSet alone;
        for (std::size_t p = pixels.size(); p-- > 0;) {
            samples_of(estimator, std::span(&pixels[p], 1), alone);
            REQUIRE(alone.u.size() == n);
            for (std::size_t i = 0; i < n; ++i) {
                REQUIRE(alone.u[i] == together.u[p * n + i]);
                REQUIRE(alone.v[i] == together.v[p * n + i]);
                REQUIRE(alone.t[i] == together.t[p * n + i]);
                if (!alone.weight.empty()) REQUIRE(alone.weight[i] == together.weight[p * n + i]);
            }
        }
    }
}

TEST_CASE("samples by density follow N_m on each axis, one in every stratum of probability") {
    for (const EstimatorKind kind : {EstimatorKind::stratified, EstimatorKind::random, EstimatorKind::sobol}) {
        for (const int m : {1, 2, 4, 5, 15, 40}) {
            const int N = 4;
            const Estimator estimator(settings(kind, N, m));
            const auto pixels = some_pixels(400);
            SampleSet set;
            estimator.pixel_samples(pixels, set);
            std::vector<double> y_u;
            std::vector<double> y_v;
            for (std::size_t i = 0; i < set.u.size(); ++i) {
                const glm::ivec2& pixel = pixels[i / (N * N)];
                y_u.push_back(filter::bspline_cdf(m, set.u[i] - (pixel.x + 0.5) + 0.5 * m));
                y_v.push_back(filter::bspline_cdf(m, set.v[i] - (pixel.y + 0.5) + 0.5 * m));
                if (kind == EstimatorKind::random) continue;
                // Stratified: sample i lies in its own cell of N x N; Sobol: in some cell that no other takes.
                if (kind != EstimatorKind::stratified) continue;
                const double column = static_cast<double>(i % N);
                const double row = static_cast<double>(i / N % N);
                REQUIRE(std::fabs(y_u.back() * N - column - 0.5) <= 0.5 + 1e-4);
                REQUIRE(std::fabs(y_v.back() * N - row - 0.5) <= 0.5 + 1e-4);
            }
            CHECK(kolmogorov_smirnov(y_u) < kKsBound);
            CHECK(kolmogorov_smirnov(y_v) < kKsBound);
        }
    }
}

TEST_CASE("times follow the filter in time, one in every stratum, and an instant takes none") {
    for (const EstimatorKind kind : {EstimatorKind::super, EstimatorKind::stratified, EstimatorKind::shared_sobol}) {
        for (const int l : {1, 3}) {
            const double open_s = 0.033;
            const Estimator estimator(settings(kind, 3, 2, open_s, l));
            SampleSet set;
            samples_of(estimator, some_pixels(500), set);
            std::vector<double> y;
            for (const double t : set.t) {
                y.push_back(filter::bspline_cdf(l, (t - (0.4 + 0.5 * open_s)) / open_s + 0.5 * l));
            }
            CHECK(kolmogorov_smirnov(y) < kKsBound);
            for (std::size_t first = 0; first < y.size(); first += 9) {
                std::sort(y.begin() + static_cast<std::ptrdiff_t>(first),
                          y.begin() + static_cast<std::ptrdiff_t>(first) + 9);
                for (std::size_t i = 0; i < 9; ++i) {
                    REQUIRE(std::fabs(y[first + i] * 9 - static_cast<double>(i) - 0.5) <= 0.5 + 1e-3);
                }
            }
        }
        const Estimator instant(settings(kind, 3, 2));
        SampleSet set;
        samples_of(instant, some_pixels(3), set);
        CHECK(std::all_of(set.t.begin(), set.t.end(), [](double t) { return t == 0.4; }));
        CHECK(set.scratch_permutation.empty());
    }
    const Estimator none(settings(EstimatorKind::none, 3, 2, 0.02, 3));
    SampleSet set;
    none.pixel_samples(some_pixels(2), set);
    CHECK(set.t.size() == 2);
    CHECK(set.t[1] == doctest::Approx(0.41).epsilon(1e-15));
}

TEST_CASE("grids: none at the centre, super over the pixel, uniform over the support") {
    const glm::ivec2 pixel(10, 20);
    SampleSet set;
    Estimator(settings(EstimatorKind::none, 5, 4)).pixel_samples(std::span(&pixel, 1), set);
    REQUIRE(set.u.size() == 1);
    CHECK(set.u[0] == 10.5);
    CHECK(set.v[0] == 20.5);
    Estimator(settings(EstimatorKind::super, 4, 9)).pixel_samples(std::span(&pixel, 1), set);
    REQUIRE(set.u.size() == 16);
    CHECK(set.weight.empty());
    for (std::size_t i = 0; i < 16; ++i) {
        CHECK(set.u[i] == doctest::Approx(10 + (static_cast<double>(i % 4) + 0.5) / 4).epsilon(1e-15));
        CHECK(set.v[i] == doctest::Approx(20 + (static_cast<double>(i / 4) + 0.5) / 4).epsilon(1e-15));
    }
    Estimator(settings(EstimatorKind::uniform, 4, 3)).pixel_samples(std::span(&pixel, 1), set);
    REQUIRE(set.weight.size() == 16);
    for (std::size_t i = 0; i < 16; ++i) {
        const double x = 3 * (static_cast<double>(i % 4) + 0.5) / 4;
        const double y = 3 * (static_cast<double>(i / 4) + 0.5) / 4;
        CHECK(set.u[i] == doctest::Approx(10.5 + x - 1.5).epsilon(1e-15));
        CHECK(set.v[i] == doctest::Approx(20.5 + y - 1.5).epsilon(1e-15));
        CHECK(set.weight[i] == doctest::Approx(filter::bspline_pdf(3, x) * filter::bspline_pdf(3, y)));
    }
}

TEST_CASE("weights as applied sum to 1, also where a high order leaves few samples any weight") {
    for (const EstimatorKind kind : support::kAllEstimators) {
        for (const int m : {1, 4, 5, 100}) {
            for (const int N : {1, 2, 5}) {
                if (m == 100 && N == 5) continue;
                const Estimator estimator(settings(kind, N, m, 0.01, 2));
                for (int x = 0; x < (m == 100 ? 1 : 5); ++x) {
                    const auto samples = estimator.probe_samples(x, -x);
                    REQUIRE(!samples.empty());
                    double sum = 0;
                    const double reach = kind == EstimatorKind::super ? 0.5 : 0.5 * m;
                    for (const ProbeSample& sample : samples) {
                        sum += sample.weight;
                        REQUIRE(sample.weight > 0);
                        REQUIRE(std::fabs(sample.u) <= reach);
                        REQUIRE(std::fabs(sample.v) <= reach);
                    }
                    REQUIRE(std::fabs(sum - 1) <= 1e-12);
                }
            }
        }
    }
}

TEST_CASE("a scene's settings carry over, with the frame's time") {
    scene::Scene scene;
    scene.sampling = {EstimatorKind::sobol, 7, 3, 2, 99};
    scene.shutter = {25.0, 0.033, 10};
    scene.surface.spin_deg_per_s = 1.0;
    const EstimatorSettings taken = estimator_settings(scene);
    CHECK(taken.kind == EstimatorKind::sobol);
    CHECK(taken.N == 7);
    CHECK(taken.m == 3);
    CHECK(taken.time_order == 2);
    CHECK(taken.shutter.frame_time_s == 0.4);
    CHECK(taken.shutter.open_s == 0.033);
}

TEST_CASE("each frame has sample positions of its own, and frame 0 those of the scene's seed") {
    scene::Scene scene;
    scene.sampling.seed = 99;
    CHECK(estimator_settings(scene).seed == 99);
    std::set<std::uint64_t> seeds;
    for (const std::uint64_t seed : {0ull, 1ull, 99ull, 0x7fff'ffff'ffff'ffffull}) {
        scene.sampling.seed = seed;
        for (int frame = 0; frame < 1000; ++frame) {
            scene.shutter.frame = frame;
            CHECK(estimator_settings(scene).seed == estimator_settings(scene).seed);
            seeds.insert(estimator_settings(scene).seed);
        }
    }
    CHECK(seeds.size() == 4000);
    // Neighbouring frames' positions in a pixel have nothing in common: of N x N in the same strata, none stays.
    scene.shutter.frame = 7;
    const auto here = Estimator(estimator_settings(scene)).probe_samples(3, 4);
    scene.shutter.frame = 8;
    const auto next = Estimator(estimator_settings(scene)).probe_samples(3, 4);
    for (std::size_t i = 0; i < here.size(); ++i) CHECK(here[i].u != next[i].u);
}
