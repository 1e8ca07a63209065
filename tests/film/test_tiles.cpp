#include <doctest/doctest.h>

#include <vector>

#include "src/film/tiles.h"

using namespace strata::film;

TEST_CASE("tiles cover every pixel of the window exactly once") {
    for (const int side : {1, 8, 33, 64, 1000}) {
        for (const Rect& window : {Rect{0, 0, 1, 1}, Rect{-5, 7, 60, 71}, Rect{3, 3, 4, 203}}) {
            const TileGrid tiles(window, side);
            std::vector<int> covered(static_cast<std::size_t>(window.width()) * window.height(), 0);
            for (std::int64_t i = 0; i < tiles.count(); ++i) {
                const Rect tile = tiles.tile(i);
                REQUIRE(tile.width() >= 1);
                REQUIRE(tile.height() >= 1);
                REQUIRE(tile.width() <= side);
                REQUIRE(tile.height() <= side);
                for (int y = tile.y0; y < tile.y1; ++y) {
                    for (int x = tile.x0; x < tile.x1; ++x) {
                        ++covered[static_cast<std::size_t>((y - window.y0) * window.width() + x - window.x0)];
                    }
                }
            }
            for (const int times : covered) REQUIRE(times == 1);
        }
    }
}

TEST_CASE("the order of work visits every tile once and begins spread over the picture") {
    for (std::int64_t count = 1; count < 1500; count += count < 300 ? 1 : 97) {
        std::vector<bool> seen(static_cast<std::size_t>(count), false);
        for (std::int64_t position = 0; position < count; ++position) {
            const std::int64_t index = spread_first(position, count);
            REQUIRE(index >= 0);
            REQUIRE(index < count);
            REQUIRE(!seen[static_cast<std::size_t>(index)]);
            seen[static_cast<std::size_t>(index)] = true;
        }
    }
    CHECK(spread_first(1, 6400) == 100);
    CHECK(spread_first(63, 6400) == 6300);
    CHECK(spread_first(64, 6400) == 1);
    CHECK(spread_first(6399, 6400) == 6399);
}
