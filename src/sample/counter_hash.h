// Random numbers without state: every number is a hash of (seed, pixel or cell, stream, index). Visiting samples in any
// order, on any thread, gives the same numbers.
//
// A stream is SplitMix64 (Steele, Lea & Flood, "Fast splittable pseudorandom number generators", 2014) entered at a
// given index: its generator is a counter with a fixed stride followed by a mixing bijection, so index i is free.
#pragma once

#include <cstdint>

#include "noise/hash.h"

namespace strata::sample {

// Independent uses of one pixel's or cell's key.
enum class Stream : std::uint64_t { space = 1, time = 2 };

inline constexpr std::uint64_t kCounterStride = 0x9E3779B97F4A7C15u;  // odd, 2^64 / golden ratio
inline constexpr std::uint64_t kStreamStride = 0xD1342543DE82EF95u;   // odd; any other will do

// x and y may be negative: cells outside the frame reach pixels inside it.
constexpr std::uint64_t cell_key(std::uint64_t seed, std::int64_t x, std::int64_t y) {
    const std::uint64_t row = noise::mix64(noise::mix64(seed + kCounterStride) + static_cast<std::uint64_t>(y));
    return noise::mix64(row + kStreamStride * static_cast<std::uint64_t>(x));
}

constexpr std::uint64_t stream_key(std::uint64_t cell_key, Stream stream) {
    return noise::mix64(cell_key + kStreamStride * static_cast<std::uint64_t>(stream));
}

constexpr std::uint64_t counter_hash(std::uint64_t stream_key, std::uint64_t index) {
    return noise::mix64(stream_key + kCounterStride * (index + 1));
}

// The seed of pass number `pass` over a picture of this seed: passes are independent of each other, and pass 0 is the
// picture itself.
constexpr std::uint64_t pass_seed(std::uint64_t seed, std::uint64_t pass) {
    constexpr std::uint64_t kPassStride = 0xA0761D6478BD642Fu;  // odd; unlike the strides of rows, cells and counters
    return pass == 0 ? seed : noise::mix64(noise::mix64(seed ^ kPassStride) + kPassStride * pass);
}

// Two independent 32-bit numbers of one hash.
constexpr std::uint32_t high_word(std::uint64_t hash) { return static_cast<std::uint32_t>(hash >> 32); }
constexpr std::uint32_t low_word(std::uint64_t hash) { return static_cast<std::uint32_t>(hash); }

}  // namespace strata::sample
