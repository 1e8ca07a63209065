// Samples of a picture made small, without loss, at a few nanoseconds a pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/journal/record.h"

namespace strata::journal {

// How samples lie in memory: pixel by pixel, `components` of `bytes` (1, 2, 4 or 8) each.
struct SampleLayout {
    std::uint32_t components = 3;
    std::uint32_t bytes = 2;

    std::size_t pixel_bytes() const { return std::size_t{components} * bytes; }
    bool operator==(const SampleLayout&) const = default;
};

// Each component becomes a row of its differences to the pixel before, taken as unsigned numbers; each row is cut into
// one of low bytes to one of high bytes, of which the high ones repeat themselves and the low ones mostly do not; and
// all that goes through zstd at its first level.
std::vector<unsigned char> pack(Bytes samples, const SampleLayout& layout);

// Throws JournalError where that is not what pack() made of `pixels` pixels.
std::vector<unsigned char> unpack(Bytes packed, const SampleLayout& layout, std::size_t pixels);

}  // namespace strata::journal
