// Renders that are gone on with: whatever an earlier process kept, the picture has the same bits, and whatever is
// handed over is the picture's.
#include <doctest/doctest.h>

#include <atomic>
#include <cstring>
#include <mutex>
#include <random>
#include <vector>

#include "src/render/progressive.h"
#include "tests/render/image_functions.h"

using namespace strata;
using namespace strata::estimate;
using namespace strata::film;
using namespace strata::parallel;
using namespace strata::render;

namespace {

bool same_bits(const Film& a, const Film& b) {
    return a.pixels().size() == b.pixels().size() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(glm::vec3)) == 0;
}

// Keeps pixels in a film, from one render to the next.
class MemoryKeeper final : public RowKeeper {
  public:
    explicit MemoryKeeper(const Rect& window) : old_(window), kept(window) {}

    // What was kept until now is what an earlier process left.
    void begin_process() { old_ = kept; }

    bool has(const Rect& part) const override {
        bool all = true;
        for (int y = part.y0; y < part.y1; ++y) {
            for (int x = part.x0; x < part.x1; ++x) all &= old_.finished(x, y);
        }
        return all;
    }
    bool is_due() override { return ++asked % 3 == 0; }

    void leaving(Film& strip, std::span<const Rect> fresh) override {
        take(strip, fresh);
        for (int y = strip.window().y0; y < strip.window().y1; ++y) {
            for (int x = strip.window().x0; x < strip.window().x1; ++x) {
                if (old_.finished(x, y)) strip.finish(x, y, old_.at(x, y));
            }
        }
    }
    void keep(std::span<const InWork> in_work) override {
        for (const InWork& work : in_work) take(*work.film, work.fresh), ++kept_in_work;
    }

    void forget(int x, int y) {
        Film left(kept.window());
        for (int v = left.window().y0; v < left.window().y1; ++v) {
            for (int u = left.window().x0; u < left.window().x1; ++u) {
                if ((u != x || v != y) && kept.finished(u, v)) left.finish(u, v, kept.at(u, v));
            }
        }
        kept = left;
    }

  private:
    void take(const Film& film, std::span<const Rect> rects) {
        inside += inside_.exchange(true) ? 1 : 0;
        for (const Rect& rect : rects) {
            for (int y = rect.y0; y < rect.y1; ++y) {
                for (int x = rect.x0; x < rect.x1; ++x) {
                    not_finished += film.finished(x, y) ? 0 : 1;
                    twice += kept.finished(x, y) && !old_.finished(x, y) ? 1 : 0;
                    kept.finish(x, y, film.at(x, y));
                }
            }
        }
        inside_ = false;
    }

    Film old_;
    std::atomic<bool> inside_{false};

  public:
    Film kept;
    std::atomic<int> asked{0};
    int kept_in_work = 0, twice = 0, not_finished = 0, inside = 0;
};

// Cancels itself after so many batches.
template <class Image>
class Stopping final : public integrate::ImageFunction {
  public:
    Stopping(const Image& image, CancelToken& cancel, int batches) : image_(image), cancel_(cancel), left_(batches) {}
    void evaluate(const integrate::SampleBatch& samples, const integrate::SampleOut& out,
                  integrate::Counters& counters) const override {
        if (left_-- <= 0) cancel_.request();
        image_.evaluate(samples, out, counters);
    }

  private:
    const Image& image_;
    CancelToken& cancel_;
    mutable std::atomic<int> left_;
};

EstimatorSettings settings_of(scene::EstimatorKind kind) {
    EstimatorSettings settings;
    settings.kind = kind;
    settings.N = 2;
    settings.m = 3;
    return settings;
}

}  // namespace

TEST_CASE("a render that is stopped at random moments and gone on with has the bits of one that went through") {
    const auto image = testing::busy();
    const Rect window{-3, 5, 94, 208};
    std::mt19937 random(11);
    int stops = 0, kept_in_work = 0;
    for (const scene::EstimatorKind kind :
         {scene::EstimatorKind::none, scene::EstimatorKind::jittered, scene::EstimatorKind::shared}) {
        const Estimator estimator(settings_of(kind));
        const Film whole = render::render(image, estimator, window, {}).film;
        for (int times = 0; times < 8; ++times) {
            MemoryKeeper keeper(window);
            for (bool is_whole = false; !is_whole;) {
                CancelToken cancel;
                const Stopping stopping(image, cancel, static_cast<int>(random() % 30));
                RenderOptions options;
                options.threads = 1 + static_cast<int>(random() % 4);
                options.tile = 1 + static_cast<int>(random() % 40);
                options.cancel = &cancel;
                options.keeper = &keeper;
                keeper.begin_process();
                const RenderResult result = render::render(stopping, estimator, window, options);
                is_whole = !result.cancelled;
                stops += is_whole ? 0 : 1;
                CHECK(is_whole == result.film.complete());
                if (is_whole) CHECK(same_bits(result.film, whole));
            }
            CHECK(same_bits(keeper.kept, whole));
            CHECK(keeper.not_finished == 0);
            CHECK(keeper.inside == 0);
            kept_in_work += keeper.kept_in_work;
        }
    }
    MESSAGE(stops << " stops, " << kept_in_work << " films in work handed over");
    CHECK(stops > 50);
    CHECK(kept_in_work > 50);
}

TEST_CASE("without a crash every pixel is handed over once, and one that is missing later is rendered again alone") {
    const auto image = testing::busy();
    const Rect window{0, 0, 90, 150};
    for (const scene::EstimatorKind kind : {scene::EstimatorKind::jittered, scene::EstimatorKind::shared}) {
        const Estimator estimator(settings_of(kind));
        MemoryKeeper keeper(window);
        RenderOptions options;
        options.threads = 3;
        options.tile = 8;
        options.keeper = &keeper;
        const RenderResult first = render::render(image, estimator, window, options);
        CHECK(keeper.twice == 0);
        CHECK(keeper.kept.complete());
        keeper.forget(17, 140);
        keeper.begin_process();
        const RenderResult again = render::render(image, estimator, window, options);
        CHECK(same_bits(again.film, first.film));
        CHECK(again.film.complete());
        CHECK(again.counters.rays > 0);
        CHECK(again.counters.rays < first.counters.rays / 3);
        keeper.begin_process();
        const RenderResult nothing = render::render(image, estimator, window, options);
        CHECK(same_bits(nothing.film, first.film));
        CHECK(nothing.counters.rays == 0);
    }
}
