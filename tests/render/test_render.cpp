#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "src/film/tiles.h"
#include "src/filter/bspline.h"
#include "src/render/render.h"
#include "tests/render/image_functions.h"
#include "tests/support/estimators.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::render;
using namespace strata::render::testing;
using scene::EstimatorKind;

namespace {

EstimatorSettings settings(EstimatorKind kind, int N, int m, double open_s = 0.01, int l = 2) {
    return {kind, N, m, l, 5, {0.04, open_s}};
}

RenderResult render_with(const ImageFunction& image, const EstimatorSettings& estimator, const Rect& window,
                         int threads = 2, int tile = 32) {
    RenderOptions options;
    options.threads = threads;
    options.tile = tile;
    return render::render(image, Estimator(estimator), window, options);
}

// Pixels of `part`'s window that differ in any bit from those of `whole`.
int differing(const Film& part, const Film& whole) {
    int count = 0;
    const Rect& window = part.window();
    for (int y = window.y0; y < window.y1; ++y) {
        for (int x = window.x0; x < window.x1; ++x) {
            count += std::memcmp(&part.at(x, y), &whole.at(x, y), sizeof(glm::vec3)) != 0 ? 1 : 0;
        }
    }
    return count;
}

constexpr Rect kFrame{0, 0, 70, 41};

}  // namespace

TEST_CASE("the bits of a picture depend neither on threads, nor on tile size, nor on the crop window") {
    const auto image = busy();
    const std::array<Rect, 5> crops{{{0, 0, 70, 41}, {3, 5, 4, 6}, {31, 7, 69, 40}, {0, 40, 70, 41}, {69, 0, 70, 41}}};
    for (const EstimatorKind kind : support::kAllEstimators) {
        for (const int m : {1, 4, 5}) {
            for (const int N : {1, 3, 4}) {
                const EstimatorSettings estimator = settings(kind, N, m);
                const RenderResult whole = render_with(image, estimator, kFrame, 1, 64);
                REQUIRE(whole.film.complete());
                int variant = 0;
                for (const int threads : {1, 2, 3, 7}) {
                    for (const int tile : {8, 16, 33, 64}) {
                        const Rect& crop = crops[static_cast<std::size_t>(variant++) % crops.size()];
                        const RenderResult part = render_with(image, estimator, crop, threads, tile);
                        REQUIRE(differing(part.film, whole.film) == 0);
                        if (crop == kFrame) REQUIRE(part.counters.rays == whole.counters.rays);
                        REQUIRE(part.counters.hits == part.counters.rays);
                    }
                }
            }
        }
    }
}

TEST_CASE("many samples a pixel: pictures that take several batches and buffers keep their bits") {
    const auto image = busy();
    const Rect frame{0, 0, 24, 13};
    for (const EstimatorKind kind : {EstimatorKind::stratified, EstimatorKind::shared, EstimatorKind::shared_sobol}) {
        const EstimatorSettings estimator = settings(kind, 64, 4);
        const RenderResult whole = render_with(image, estimator, frame, 1, 64);
        const RenderResult split = render_with(image, estimator, frame, 3, 8);
        CHECK(differing(split.film, whole.film) == 0);
        const RenderResult crop = render_with(image, estimator, {5, 3, 20, 11}, 2, 16);
        CHECK(differing(crop.film, whole.film) == 0);
    }
}

TEST_CASE("a constant picture is exact under every estimator") {
    const glm::vec3 value(0.1f, 7.3e-5f, 12345.678f);
    const auto image = constant(value);
    for (const EstimatorKind kind : support::kAllEstimators) {
        for (const int m : {1, 2, 4, 7, 100}) {
            for (const int N : {1, 2, 3, 8}) {
                if (m == 100 && N == 8) continue;
                const RenderResult result = render_with(image, settings(kind, N, m), {-3, 2, 9, 7});
                for (const glm::vec3& pixel : result.film.pixels()) REQUIRE(pixel == value);
            }
        }
    }
}

TEST_CASE("a pixel is the weighted sum of its probed samples") {
    const auto image = busy();
    double worst = 0;
    for (const EstimatorKind kind : support::kAllEstimators) {
        for (const int m : {1, 4, 5}) {
            const Estimator estimator(settings(kind, 3, m));
            const Rect window{20, 10, 24, 13};
            const RenderResult result = render::render(image, estimator, window);
            for (int y = window.y0; y < window.y1; ++y) {
                for (int x = window.x0; x < window.x1; ++x) {
                    glm::dvec3 sum(0.0);
                    for (const ProbeSample& sample : estimator.probe_samples(x, y)) {
                        const double u = x + 0.5 + sample.u;
                        const double v = y + 0.5 + sample.v;
                        glm::vec3 radiance;
                        Counters counters;
                        image.evaluate({{&u, 1}, {&v, 1}, {&sample.time_s, 1}}, std::span(&radiance, 1), counters);
                        sum += sample.weight * glm::dvec3(radiance);
                    }
                    const glm::dvec3 error = glm::abs(sum - glm::dvec3(result.film.at(x, y)));
                    worst = std::max({worst, error.x, error.y, error.z / 50});
                }
            }
        }
    }
    MESSAGE("greatest difference: ", worst, " (float rounding is 6e-8)");
    CHECK(worst < 1e-7);
}

TEST_CASE("shared samples are weighted by n_m at the pixel, cell by cell") {
    const auto image = busy();
    double worst = 0;
    for (const EstimatorKind kind : support::estimators_where(&scene::EstimatorRow::is_shared)) {
        for (const int m : {1, 2, 3, 4, 5, 9}) {
            const Estimator estimator(settings(kind, 2, m));
            const Rect window{12, 7, 15, 9};
            const RenderResult result = render::render(image, estimator, window);
            for (int y = window.y0; y < window.y1; ++y) {
                for (int x = window.x0; x < window.x1; ++x) {
                    glm::dvec3 sum(0.0);
                    double total = 0;
                    for (int cell = 0; cell < 400; ++cell) {
                        const glm::ivec2 position(x - 10 + cell % 20, y - 10 + cell / 20);
                        SampleSet set;
                        estimator.cell_samples(std::span(&position, 1), set);
                        std::vector<glm::vec3> radiance(set.u.size());
                        Counters counters;
                        image.evaluate(set.batch(0, set.u.size()), radiance, counters);
                        for (std::size_t i = 0; i < set.u.size(); ++i) {
                            const double weight = filter::bspline_pdf(m, set.u[i] - (x + 0.5) + 0.5 * m) *
                                                  filter::bspline_pdf(m, set.v[i] - (y + 0.5) + 0.5 * m);
                            sum += weight * glm::dvec3(radiance[i]);
                            total += weight;
                        }
                    }
                    const glm::dvec3 error = glm::abs(sum / total - glm::dvec3(result.film.at(x, y)));
                    worst = std::max({worst, error.x, error.y, error.z / 50});
                }
            }
        }
    }
    MESSAGE("greatest difference: ", worst, " (float rounding is 6e-8)");
    CHECK(worst < 1e-7);
}

TEST_CASE("every cell or pixel is sampled exactly once") {
    const auto image = constant(glm::vec3(1));
    for (const EstimatorKind kind : support::kAllEstimators) {
        for (const int m : {1, 4, 5}) {
            const RenderResult result = render_with(image, settings(kind, 3, m), {4, 4, 37, 25}, 3, 8);
            const bool shared = scene::row_of(kind).is_shared();
            const std::uint64_t margin = shared ? 2 * static_cast<std::uint64_t>(m / 2) : 0;
            const std::uint64_t n = scene::row_of(kind).is_single ? 1 : 9;
            CHECK(result.counters.rays == n * (33 + margin) * (21 + margin));
        }
    }
}

TEST_CASE("extreme shapes and orders render completely and without NaN") {
    const auto image = busy();
    for (const EstimatorKind kind : support::kAllEstimators) {
        for (const Rect& window : {Rect{0, 0, 1, 1}, Rect{0, 0, 1, 2000}, Rect{0, 0, 2000, 1}}) {
            const RenderResult result = render_with(image, settings(kind, 1, 4), window);
            REQUIRE(result.film.complete());
            REQUIRE(!result.cancelled);
        }
        for (const auto& [N, m] : {std::pair{64, 1}, std::pair{1, 100}, std::pair{2, 100}}) {
            const RenderResult result = render_with(image, settings(kind, N, m), {0, 0, 2, 3});
            REQUIRE(result.film.complete());
            for (const glm::vec3& pixel : result.film.pixels()) {
                REQUIRE(pixel.x >= 0);
                REQUIRE(pixel.x <= 1);
            }
        }
    }
}

TEST_CASE("an empty window and a tile of no size are refused") {
    const auto image = constant(glm::vec3(1));
    CHECK_THROWS_AS(render_with(image, settings(EstimatorKind::none, 1, 1), {5, 5, 5, 9}), std::invalid_argument);
    CHECK_THROWS_AS(render_with(image, settings(EstimatorKind::none, 1, 1), {0, 0, 4, 4}, 1, 0), std::invalid_argument);
}
