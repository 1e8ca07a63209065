#include "src/film/tiles.h"

#include <algorithm>

namespace strata::film {

TileGrid::TileGrid(const Rect& window, int side)
    : window_(window),
      side_(side),
      columns_(divide_up(window.width(), side)),
      rows_(divide_up(window.height(), side)) {}

Rect TileGrid::tile(std::int64_t index) const {
    const std::int64_t x = index % columns_ * side_;
    const std::int64_t y = index / columns_ * side_;
    return {window_.x0 + static_cast<int>(x), window_.y0 + static_cast<int>(y),
            window_.x0 + static_cast<int>(std::min<std::int64_t>(x + side_, window_.width())),
            window_.y0 + static_cast<int>(std::min<std::int64_t>(y + side_, window_.height()))};
}

std::int64_t spread_count(std::int64_t count, std::int64_t most) {
    const std::int64_t stride = divide_up(count, most);
    return stride <= 1 ? 0 : divide_up(count, stride);
}

std::int64_t spread_first(std::int64_t position, std::int64_t count, std::int64_t most) {
    const std::int64_t stride = divide_up(count, most);
    if (stride <= 1) return position;
    const std::int64_t spread = divide_up(count, stride);
    if (position < spread) return position * stride;
    const std::int64_t rest = position - spread;
    return rest / (stride - 1) * stride + 1 + rest % (stride - 1);
}

}  // namespace strata::film
