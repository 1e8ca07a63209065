#include "src/image/not_finite.h"

#include <fmt/format.h>

#include <cmath>

namespace strata::image {

bool is_finite_pixel(const Picture& picture, std::size_t pixel) {
    const float* rgb = &picture.rgb[3 * pixel];
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

std::string describe_not_finite(const Picture& picture) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = 0; i < picture.pixels(); ++i)
        if (!is_finite_pixel(picture, i) && count++ == 0) first = i;
    if (count == 0) return "";
    const auto width = static_cast<std::size_t>(picture.width());
    const float* rgb = &picture.rgb[3 * first];
    return fmt::format("{} pixel{} not finite, first ({},{}) = ({}, {}, {})", count, count == 1 ? " is" : "s are",
                       static_cast<std::size_t>(picture.x0) + first % width,
                       static_cast<std::size_t>(picture.y0) + first / width, rgb[0], rgb[1], rgb[2]);
}

}  // namespace strata::image
