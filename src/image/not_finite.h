// Pixels that hold a NaN or an infinity: none of ours do, those of other programs may.
#pragma once

#include <cstddef>
#include <string>

#include "src/image/picture.h"

namespace strata::image {

// Of the pixel's three values, counted from the crop's top left.
bool is_finite_pixel(const Picture& picture, std::size_t pixel);

// "3 pixels are not finite, first (12,6) = (nan, 0, 0)", places in the frame; empty where all are finite.
std::string describe_not_finite(const Picture& picture);

}  // namespace strata::image
