// Pixels as the samples that files store: halves, and codes of 8 and 16 bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/image/colour_out.h"

namespace strata::image {

inline constexpr float kMaxHalf = 65504.0f;

// Of a TIFF: the nearest code of 16 bits to finite linear radiance, three values a pixel.
std::vector<std::uint16_t> codes_of_16_bits(std::span<const float> linear, const ColourOut& colour);

// Of PNG and JPEG: codes of 8 bits, dithered by the pixels' places in the frame: rows of `width` pixels, the first at
// (x0,y0).
std::vector<std::uint8_t> codes_of_8_bits(std::span<const float> linear, const ColourOut& colour, int x0, int y0,
                                          int width);

// Bit patterns of the nearest halves; values in [-kMaxHalf,kMaxHalf]. Every half is a float, so that an EXR of the
// floats that come back has the bits of one of the floats that went in.
std::vector<std::uint16_t> halves(std::span<const float> values);
std::vector<float> floats(std::span<const std::uint16_t> halves);

}  // namespace strata::image
