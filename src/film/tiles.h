// A window cut into square tiles.
#pragma once

#include <cstdint>

#include "src/film/film.h"

namespace strata::film {

// a / b, rounded up; b > 0.
constexpr std::int64_t divide_up(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

class TileGrid {
  public:
    // side >= 1; tiles at the right and lower border are cut.
    TileGrid(const Rect& window, int side);

    std::int64_t count() const { return columns_ * rows_; }

    // Tile `index`, row by row.
    Rect tile(std::int64_t index) const;

  private:
    Rect window_;
    int side_;
    std::int64_t columns_;
    std::int64_t rows_;
};

// The order of work: a permutation of [0,count) that begins with at most `most` >= 1 indices spread evenly, on which a
// prediction of the whole can rest, and goes on with the rest in ascending order.
inline constexpr std::int64_t kSpreadTiles = 64;
std::int64_t spread_first(std::int64_t position, std::int64_t count, std::int64_t most = kSpreadTiles);

// How many positions are of indices ahead of their order: 0 where all are in order.
std::int64_t spread_count(std::int64_t count, std::int64_t most);

}  // namespace strata::film
