// What an ICC profile says of how a picture's values stand for light.
#pragma once

#include <optional>
#include <span>

namespace strata::image {

// The exponent g of the profile's curve, light = value^g, which is 1 for a linear one. Nothing where the curve is no
// power - sRGB's is none - or the profile tells of none that can be read. Of a colour profile red's curve stands for
// all: profiles whose channels differ are made by measuring a device.
std::optional<double> power_of_icc(std::span<const unsigned char> profile);

}  // namespace strata::image
