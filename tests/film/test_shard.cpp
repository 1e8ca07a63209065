#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "src/film/shard.h"

using namespace strata::film;

namespace {

// How often each pixel of the window is in a shard.
std::vector<int> covered(const Rect& window, int count) {
    std::vector<int> times(static_cast<std::size_t>(window.width()) * window.height(), 0);
    for (int number = 1; number <= count; ++number) {
        const ShardPicture part(window, {number, count});
        std::int64_t pixels = 0;
        for (std::int64_t i = 0; i < part.slots(); ++i) {
            const Rect block = part.block(i), slot = part.slot(i);
            REQUIRE(block.width() <= slot.width());
            REQUIRE(block.height() <= slot.height());
            REQUIRE(slot.x1 <= part.window().x1);
            REQUIRE(slot.y1 <= part.window().y1);
            for (int y = block.y0; y < block.y1; ++y) {
                for (int x = block.x0; x < block.x1; ++x, ++pixels) {
                    ++times[static_cast<std::size_t>(y - window.y0) * window.width() + x - window.x0];
                }
            }
        }
        CHECK(pixels == part.pixels());
    }
    return times;
}

}  // namespace

TEST_CASE("the shards of a window hold each of its pixels once") {
    for (const Rect& window :
         {Rect{0, 0, 1920, 1080}, Rect{-3, 5, 130, 700}, Rect{10, 20, 11, 21}, Rect{0, 0, 64, 640}}) {
        const ShardDeal deal(window, 1);
        for (const int count : {1, 2, 3, 7, 16, 100}) {
            if (count > deal.blocks()) continue;
            const std::vector<int> times = covered(window, count);
            CHECK(std::ranges::all_of(times, [](int n) { return n == 1; }));
        }
    }
}

TEST_CASE("shards have as many blocks as one another, or one more or less, in the order of the whole") {
    const Rect window{0, 0, 3840, 2160};
    for (const int count : {2, 8, 16, 33}) {
        const std::int64_t blocks = ShardDeal(window, count).blocks();
        for (int number = 1; number <= count; ++number) {
            const ShardPicture part(window, {number, count});
            std::int64_t own = 0, last = -1;
            for (std::int64_t i = 0; i < part.slots(); ++i) {
                const Rect block = part.block(i);
                if (block.width() == 0) continue;
                const std::int64_t index = std::int64_t{block.y0 / 64} * 60 + block.x0 / 64;
                CHECK(index > last);
                last = index;
                ++own;
            }
            CHECK(own >= blocks / count);
            CHECK(own <= blocks / count + 1);
            // Whoever reads all parts row by row needs no more of them at a time than of the whole.
            CHECK(part.slots_a_row() <= (60 + count - 1) / count);
            CHECK(part.window().height() <= 2160 + 64 * (1 + 60 / count));
        }
    }
}

// What a picture costs changes slowly from row to row (sky, horizon, foreground): then the shares of 16 shards of a
// full-HD picture, 32 blocks each, differ by a percent. Where one column in 15 costs ten times the others, a shard has
// 2.1 of the 34 dear blocks by expectation, and 1.4 more or less by chance, which is a quarter of its cost: the largest
// of 16 is expected at 1.8 deviations, and bounded at three.
TEST_CASE("where rows or columns of a picture cost more than others, shards cost about the same") {
    const Rect window{0, 0, 1920, 1080};
    constexpr int kCount = 16;
    const auto largest_share = [&](auto cost) {
        double all = 0, most = 0;
        for (int number = 1; number <= kCount; ++number) {
            const ShardPicture part(window, {number, kCount});
            double own = 0;
            for (std::int64_t i = 0; i < part.slots(); ++i) {
                const Rect b = part.block(i);
                own += b.width() * b.height() * cost(b.x0 / 64, b.y0 / 64);
            }
            all += own;
            most = std::max(most, own);
        }
        return most * kCount / all;
    };
    const double even = largest_share([](int, int) { return 1.0; });
    const double rows = largest_share([](int, int y) { return y < 8 ? 0.1 : 30.0 - y; });
    const double columns = largest_share([](int x, int) { return x % 16 == 3 ? 10.0 : 1.0; });
    const double peak = largest_share([](int x, int y) { return x < 2 && y < 2 ? 100.0 : 1.0; });
    MESSAGE("largest share of 16, of its even part: even " << even << ", rows " << rows << ", columns " << columns
                                                           << ", four dear blocks " << peak);
    CHECK(even < 1.05);
    CHECK(rows < 1.15);
    CHECK(columns < 1.75);
    CHECK(peak < 5);
}

TEST_CASE("pictures of more samples than 2^31 and of all sizes a frame may have are dealt in 64 bits") {
    const Rect window{0, 0, 65536, 65536};
    const ShardDeal deal(window, 7);
    CHECK(deal.blocks() == 1024 * 1024);
    const Rect last = deal.block(deal.blocks() - 1);
    CHECK(last == Rect{65472, 65472, 65536, 65536});
    std::int64_t pixels = 0;
    for (int number = 1; number <= 7; ++number) pixels += ShardPicture(window, {number, 7}).pixels();
    CHECK(pixels == std::int64_t{1} << 32);
}
