// How far a picture is from its reference, in linear radiance.
#pragma once

#include <array>
#include <cstddef>

#include "src/image/picture.h"

namespace strata::image {

// Over all finite values d = picture - reference of all three channels; every figure is NaN when no value is finite.
struct Comparison {
    double rmse = 0;                       // sqrt(mean d^2)
    std::array<double, 3> channel_rmse{};  // the same for red, green and blue alone
    double relative_rmse = 0;    // rmse over the reference's root mean square; 0 for equal, infinite over a black one
    double max_abs = 0;          // largest |d|
    double percentile99 = 0;     // the least |d| that at least 99 % of the values do not exceed
    std::size_t not_finite = 0;  // values (not pixels) left out, since they are NaN or infinite in either picture
};

// Compares pixel by pixel from the top left of both crops, wherever they lie in their frames. Sums are doubles. Throws
// ImageError, naming both sizes, unless they are equal.
Comparison compare(const Picture& picture, const Picture& reference);

// The same check alone. `what` and `other` name the pictures in the message.
void require_equal_sizes(const Picture& picture, const Picture& reference, const char* what = "the picture",
                         const char* other = "the reference");

}  // namespace strata::image
