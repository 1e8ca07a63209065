// The transfer function of sRGB, IEC 61966-2-1:1999.
#pragma once

#include <algorithm>
#include <cmath>

namespace strata::image {

// Linear light to the encoded value; the argument is clamped to [0,1]. Infinite arguments are allowed, NaN is not.
inline double encode_srgb(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

// The inverse, for encoded values in [0,1].
inline double decode_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace strata::image
