#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include "src/render/render.h"
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

// Requests cancellation once so many samples have been evaluated.
class CancelAfter : public ImageFunction {
  public:
    CancelAfter(CancelToken& token, std::int64_t samples) : token_(token), left_(samples) {}

    void evaluate(const SampleBatch& samples, const SampleOut& out, Counters& counters) const override {
        image_.evaluate(samples, out, counters);
        if ((left_ -= static_cast<std::int64_t>(samples.u.size())) <= 0) token_.request();
    }

  private:
    CancelToken& token_;
    mutable std::atomic<std::int64_t> left_;
    decltype(busy()) image_ = busy();
};

}  // namespace

TEST_CASE("a cancelled render has some pixels, each as in the whole render, and zero elsewhere") {
    const auto image = busy();
    const Rect window{0, 0, 160, 140};
    for (const EstimatorKind kind : support::kAllEstimators) {
        const bool shared = kind == EstimatorKind::shared || kind == EstimatorKind::shared_sobol;
        const Estimator estimator({kind, shared ? 8 : 4, 4, 1, 1, {0.04, 0.01}});
        const RenderResult whole = render::render(image, estimator, window);
        CHECK(!whole.cancelled);
        CancelToken token;
        RenderOptions options;
        options.threads = 2;
        options.cancel = &token;
        const RenderResult part = render::render(CancelAfter(token, static_cast<std::int64_t>(whole.counters.rays / 2)),
                                                 estimator, window, options);
        CHECK(part.cancelled);
        CHECK(part.film.finished_count() > 0);
        CHECK(part.film.finished_count() < whole.film.finished_count());
        CHECK(part.counters.rays < whole.counters.rays);
        CHECK(part.counters.rays == part.counters.hits);
        int wrong = 0;
        for (int y = 0; y < window.y1; ++y) {
            for (int x = 0; x < window.x1; ++x) {
                const glm::vec3 expected = part.film.finished(x, y) ? whole.film.at(x, y) : glm::vec3(0);
                wrong += std::memcmp(&expected, &part.film.at(x, y), sizeof expected) != 0 ? 1 : 0;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("a render of slow samples stops within 0.2 s of the request") {
    const auto slow = Formula([](double, double, double) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(20);
        while (std::chrono::steady_clock::now() < end) {
        }
        return glm::vec3(1);
    });
    for (const auto& [kind, N] : {std::pair{EstimatorKind::stratified, 64}, std::pair{EstimatorKind::shared, 4}}) {
        CancelToken token;
        std::chrono::steady_clock::time_point requested;
        std::thread canceller([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(150));
            requested = std::chrono::steady_clock::now();
            token.request();
        });
        RenderOptions options;
        options.cancel = &token;
        const RenderResult result =
            render::render(slow, Estimator({kind, N, 4, 1, 1, {}}), Rect{0, 0, 400, 400}, options);
        const auto stopped = std::chrono::steady_clock::now();
        canceller.join();
        CHECK(result.cancelled);
        const double seconds = std::chrono::duration<double>(stopped - requested).count();
        MESSAGE("stopped after ", seconds, " s of 0.2 s");
        CHECK(seconds < 0.2);
    }
}
