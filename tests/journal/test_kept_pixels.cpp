#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "src/journal/kept_pixels.h"

using namespace strata::journal;
using strata::film::Rect;
using strata::film::StripLayout;

TEST_CASE("a rectangle is there when all its pixels are, in whatever records") {
    const StripLayout layout{{-5, 3, 40, 60}, 16};
    std::mt19937_64 random(10);
    const auto between = [&](int a, int b) { return a + static_cast<int>(random() % static_cast<unsigned>(b - a)); };
    const auto random_rect = [&] {
        const Rect strip = layout.strip(between(0, layout.count()));
        const int x0 = between(strip.x0, strip.x1), y0 = between(strip.y0, strip.y1);
        // Rows, as the shared estimators finish them.
        if (random() % 4 == 0) return Rect{strip.x0, y0, strip.x1, between(y0 + 1, strip.y1 + 1)};
        return Rect{x0, y0, between(x0 + 1, strip.x1 + 1), between(y0 + 1, strip.y1 + 1)};
    };
    int there = 0, asked = 0;
    for (int times = 0; times < 20; ++times) {
        KeptPixels kept(layout);
        std::vector<std::vector<bool>> oracle(57, std::vector<bool>(45, false));
        const auto count = [&](const Rect& rect) {
            int pixels = 0;
            for (int y = rect.y0; y < rect.y1; ++y) {
                for (int x = rect.x0; x < rect.x1; ++x) pixels += oracle[y - 3][x + 5];
            }
            return pixels;
        };
        for (int i = 0; i < 60; ++i) {
            const Rect rect = i % 20 == 7 ? layout.strip(between(0, layout.count())) : random_rect();
            REQUIRE(kept.add({1, i, 1}, {&rect, 1}));
            for (int y = rect.y0; y < rect.y1; ++y) {
                for (int x = rect.x0; x < rect.x1; ++x) oracle[y - 3][x + 5] = true;
            }
            CHECK(kept.pixels() == count(layout.window));
            for (int j = 0; j < 20; ++j) {
                const Rect probe = random_rect();
                const bool expected = count(probe) == probe.width() * probe.height();
                CHECK(kept.has(probe) == expected);
                there += expected;
                ++asked;
            }
            const auto records = kept.records_of(layout.strip_at(rect.y0));
            CHECK(records.back().offset == i);
        }
    }
    MESSAGE("there: " << there << " of " << asked);
    CHECK(there > 1000);
    CHECK(there < asked - 1000);
}

TEST_CASE("a record with a rectangle outside the film, or across its strips, does not count") {
    const StripLayout layout{{0, 0, 40, 60}, 16};
    KeptPixels kept(layout);
    for (const Rect& rect :
         {Rect{-1, 0, 4, 4}, Rect{0, 0, 41, 4}, Rect{0, 15, 4, 17}, Rect{0, 58, 4, 61}, Rect{0, -9, 4, -5}}) {
        const std::vector<Rect> rects{{0, 0, 1, 1}, rect};
        CHECK(!kept.add({1, 0, 1}, rects));
        CHECK(kept.pixels() == 0);
    }
}

TEST_CASE("pictures of 2^32 pixels are counted in full, and strips that are whole take no memory a pixel") {
    const StripLayout layout{{0, 0, 65536, 65536}, 64};
    KeptPixels kept(layout);
    for (int i = 0; i < layout.count(); ++i) {
        const Rect strip = layout.strip(i);
        REQUIRE(kept.add({1, std::int64_t{i} << 32, 1}, {&strip, 1}));
    }
    CHECK(kept.pixels() == std::int64_t{1} << 32);
    CHECK(kept.has({65535, 65535, 65536, 65536}));
    CHECK(kept.records_of(1023).front().offset == std::int64_t{1023} << 32);
}
