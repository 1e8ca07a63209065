#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include "src/render/render.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::integrate;
using namespace strata::parallel;
using namespace strata::render;

namespace {

// A picture whose samples cost nothing, but those of some pixels, which hold up the strips behind them.
class Uneven final : public ImageFunction {
  public:
    void evaluate(const SampleBatch& samples, const SampleOut& out, Counters&) const override {
        for (std::size_t i = 0; i < out.radiance.size(); ++i) {
            const auto u = static_cast<float>(samples.u[i]), v = static_cast<float>(samples.v[i]);
            out.radiance[i] = {u, v, u * v};
        }
        if (samples.u[0] < 8 && static_cast<int>(samples.v[0]) % 96 < 8) {
            std::this_thread::sleep_for(std::chrono::milliseconds(3));
        }
    }
};

// The frame put together from strips, each checked to be the next one.
struct Collector {
    Rect window;
    int rows;
    Film film{window};
    int next = window.y0;
    int wrong = 0;
    std::atomic<int> inside{0};

    void operator()(const Film& strip) {
        wrong += inside.fetch_add(1) != 0 ? 1 : 0;
        const Rect expected{window.x0, next, window.x1, std::min(next + rows, window.y1)};
        wrong += strip.window() == expected ? 0 : 1;
        film.paste(strip);
        next = expected.y1;
        inside.fetch_sub(1);
    }
};

bool same_bits(const Film& a, const Film& b) {
    return a.pixels().size() == b.pixels().size() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(glm::vec3)) == 0;
}

constexpr scene::EstimatorKind kKinds[] = {scene::EstimatorKind::none, scene::EstimatorKind::stratified,
                                           scene::EstimatorKind::jittered, scene::EstimatorKind::shared_sobol};

EstimatorSettings settings(scene::EstimatorKind kind, int N = 2) {
    EstimatorSettings settings;
    settings.kind = kind;
    settings.N = N;
    return settings;
}

RenderOptions options(int threads, int tile, const CancelToken* cancel = nullptr) {
    RenderOptions options;
    options.threads = threads;
    options.tile = tile;
    options.cancel = cancel;
    return options;
}

}  // namespace

TEST_CASE("strips come in order, one at a time, and make up the film, whatever threads, tiles and strips") {
    const Uneven image;
    const Rect window{-3, 5, 94, 208};
    for (const scene::EstimatorKind kind : kKinds) {
        const Estimator estimator(settings(kind));
        const Film whole = render::render(image, estimator, window, options(1, 32)).film;
        REQUIRE(whole.complete());
        for (const int threads : {1, 3, 8}) {
            for (const auto& [tile, rows] : {std::pair{32, 64}, {7, 64}, {500, 16}, {48, 1}, {5, 1000}}) {
                Collector sink{window, rows};
                const RenderResult result = render_strips(image, estimator, window, options(threads, tile), rows,
                                                          [&](const Film& strip) { sink(strip); });
                CHECK(sink.wrong == 0);
                CHECK(sink.next == window.y1);
                CHECK(same_bits(sink.film, whole));
                CHECK(result.finished_pixels == 97 * 203);
                CHECK(!result.cancelled);
            }
        }
    }
}

TEST_CASE("the pixels held at once do not grow with the height of the picture, however uneven the work") {
    const Uneven image;
    constexpr int kWidth = 96, kRows = 16;
    constexpr std::size_t kStripBytes = kWidth * kRows * (sizeof(glm::vec3) + 1);
    for (const scene::EstimatorKind kind : kKinds) {
        const Estimator estimator(settings(kind, 1));
        const bool shared = estimator.shared();
        for (const int threads : {1, 4}) {
            const auto most = [&](int height) {
                return render_strips(image, estimator, {0, 0, kWidth, height}, options(threads, 16), kRows,
                                     [](const Film&) {})
                    .most_film_bytes;
            };
            const std::size_t low = most(20 * kRows), high = most(400 * kRows);
            // Strips in work, and tiles that were rendered ahead.
            const std::size_t allowed = shared ? 6 * kStripBytes : 5 * kStripBytes + 64 * kStripBytes / 6;
            MESSAGE(threads << " threads: " << low << " and " << high << " bytes, allowed " << allowed);
            CHECK(low >= kStripBytes);
            CHECK(high <= allowed);
            CHECK(high * 10 < std::size_t{400} * kStripBytes);
        }
    }
}

TEST_CASE("a slow sink holds the render up instead of letting strips pile up") {
    const Uneven image;
    const Estimator estimator(settings(scene::EstimatorKind::none));
    constexpr std::size_t kStripBytes = 64 * 8 * (sizeof(glm::vec3) + 1);
    const RenderResult result = render_strips(image, estimator, {0, 0, 64, 400}, options(4, 8), 8, [](const Film&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    });
    const double strips = static_cast<double>(result.most_film_bytes) / kStripBytes;
    MESSAGE(strips << " strips were held");
    CHECK(result.most_film_bytes <= (4 + 8) * kStripBytes);
}

TEST_CASE("a cancelled render gives all strips away, black where it was not finished") {
    const Uneven image;
    const Rect window{0, 0, 60, 333};
    for (const scene::EstimatorKind kind : kKinds) {
        const Estimator estimator(settings(kind));
        const Film whole = render::render(image, estimator, window).film;
        CancelToken cancel;
        Collector sink{window, 8};
        const RenderResult result =
            render_strips(image, estimator, window, options(3, 8, &cancel), 8, [&](const Film& strip) {
                sink(strip);
                if (strip.window().y0 == 80) cancel.request();
            });
        CHECK(result.cancelled);
        CHECK(sink.wrong == 0);
        CHECK(sink.next == window.y1);
        CHECK(static_cast<std::size_t>(result.finished_pixels) == sink.film.finished_count());
        CHECK(result.finished_pixels >= 88 * 60);
        int wrong = 0;
        for (int y = 0; y < window.y1; ++y) {
            for (int x = 0; x < window.x1; ++x) {
                wrong += sink.film.at(x, y) == (sink.film.finished(x, y) ? whole.at(x, y) : glm::vec3(0)) ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("what a sink throws ends neither in a deadlock nor in silence, and it is called no more") {
    const Uneven image;
    for (const scene::EstimatorKind kind : kKinds) {
        int calls = 0;
        const auto sink = [&](const Film& strip) {
            ++calls;
            if (strip.window().y0 >= 32) throw std::runtime_error("full");
        };
        CHECK_THROWS_WITH_AS(render_strips(image, Estimator(settings(kind)), {0, 0, 40, 400}, options(3, 8), 8, sink),
                             "full", std::runtime_error);
        CHECK(calls == 5);
    }
}

TEST_CASE("what an image function throws does not leave threads waiting for its tile") {
    class Broken final : public ImageFunction {
      public:
        void evaluate(const SampleBatch& samples, const SampleOut& out, Counters&) const override {
            if (samples.v[0] > 50 && samples.u[0] < 8) throw std::runtime_error("broken");
            std::ranges::fill(out.radiance, glm::vec3(1));
        }
    };
    for (const scene::EstimatorKind kind : kKinds) {
        CHECK_THROWS_WITH_AS(
            render_strips(Broken(), Estimator(settings(kind)), {0, 0, 40, 4000}, options(4, 8), 8, [](const Film&) {}),
            "broken", std::runtime_error);
    }
}
