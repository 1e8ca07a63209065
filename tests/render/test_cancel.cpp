#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <functional>
#include <thread>

#include "src/render/render.h"
#include "tests/render/image_functions.h"

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

    void evaluate(const SampleBatch& samples, std::span<glm::vec3> radiance, Counters& counters) const override {
        image_.evaluate(samples, radiance, counters);
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
    for (const EstimatorKind kind : kAllEstimators) {
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

namespace {

// How a child process ends in which `body` runs.
int end_of(const std::function<void()>& body) {
    const pid_t child = fork();
    if (child == 0) {
        body();
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("SIGINT, SIGTERM and SIGHUP cancel and are remembered; a second one ends the program") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const int end = end_of([&] {
            std::signal(signal, SIG_DFL);
            static CancelToken token;
            cancel_on_signals(token);
            if (cancelling_signal() != 0 || token.requested()) _exit(1);
            std::raise(signal);
            if (!token.requested() || cancelling_signal() != signal) _exit(2);
            std::raise(signal);  // at once: part of the first
            std::this_thread::sleep_for(std::chrono::milliseconds(150));
            std::raise(signal);
        });
        CHECK(end == 128 + signal);
    }
}

TEST_CASE("a signal that was ignored before stays ignored") {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        const int end = end_of([&] {
            std::signal(signal, SIG_IGN);
            static CancelToken token;
            parallel::call_on_signals([](int, bool) { _exit(1); });
            cancel_on_signals(token);
            std::raise(signal);
            if (token.requested()) _exit(2);
        });
        CHECK(end == 0);
    }
}

TEST_CASE("the hook hears of the first signal and of the one that ends the program") {
    const int end = end_of([] {
        static CancelToken token;
        static int first_calls = 0;
        std::signal(SIGTERM, SIG_DFL);
        parallel::call_on_signals([](int, bool is_last) {
            if (is_last) _exit(first_calls == 1 ? 77 : 78);
            ++first_calls;
        });
        cancel_on_signals(token);
        std::raise(SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        std::raise(SIGTERM);
    });
    CHECK(end == 77);
}
