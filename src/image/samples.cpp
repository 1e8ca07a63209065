#include "src/image/samples.h"

#include <cmath>
#include <limits>

#include "src/image/dither.h"
#include "src/image/openimageio.h"

namespace strata::image {
namespace {

void convert(OIIO::TypeDesc from, const void* source, OIIO::TypeDesc to, void* target, std::size_t count) {
    // Counts of the library are ints.
    constexpr std::size_t kBlock = 1 << 24;
    for (std::size_t done = 0; done < count; done += kBlock) {
        OIIO::convert_pixel_values(from, static_cast<const char*>(source) + done * from.size(), to,
                                   static_cast<char*>(target) + done * to.size(),
                                   static_cast<int>(std::min(kBlock, count - done)));
    }
}

}  // namespace

std::vector<std::uint16_t> codes_of_16_bits(std::span<const float> linear, const ColourOut& colour) {
    constexpr double kTop = std::numeric_limits<std::uint16_t>::max();
    const ColourEncoder encode(colour);
    std::vector<std::uint16_t> codes;
    codes.reserve(linear.size());
    for (std::size_t i = 0; i < linear.size(); i += 3) {
        const glm::dvec3 encoded = encode(&linear[i]);
        for (int c = 0; c < 3; ++c) codes.push_back(static_cast<std::uint16_t>(std::lround(encoded[c] * kTop)));
    }
    return codes;
}

std::vector<std::uint8_t> codes_of_8_bits(std::span<const float> linear, const ColourOut& colour, int x0, int y0,
                                          int width) {
    const ColourEncoder encode(colour);
    std::vector<std::uint8_t> codes;
    codes.reserve(linear.size());
    const std::size_t row = 3 * static_cast<std::size_t>(width);
    for (std::size_t i = 0; i < linear.size(); i += 3) {
        const int x = x0 + static_cast<int>(i % row / 3), y = y0 + static_cast<int>(i / row);
        const glm::dvec3 encoded = encode(&linear[i]);
        for (int c = 0; c < 3; ++c) codes.push_back(static_cast<std::uint8_t>(dithered_code(encoded[c], x, y)));
    }
    return codes;
}

std::vector<std::uint16_t> halves(std::span<const float> values) {
    std::vector<std::uint16_t> result(values.size());
    convert(OIIO::TypeDesc::FLOAT, values.data(), OIIO::TypeDesc::HALF, result.data(), values.size());
    return result;
}

std::vector<float> floats(std::span<const std::uint16_t> halves) {
    std::vector<float> result(halves.size());
    convert(OIIO::TypeDesc::HALF, halves.data(), OIIO::TypeDesc::FLOAT, result.data(), halves.size());
    return result;
}

}  // namespace strata::image
