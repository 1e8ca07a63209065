// Stratified numbers of [0,1), in two forms: as they are (positions in a cell), and folded about 1/2 (arguments of an
// inverse distribution function, where small tails must keep their relative precision).
//
// A folded number q in [-1/2,1/2] stands for y = |q| if its sign bit is set, y = 1 - |q| if not: |q| is the probability
// of the tail beyond y on y's own side of the median. filter::BsplineTable::centred takes this form.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace strata::sample {

inline constexpr float kBelowOne = 0x1.fffffep-1f;  // the largest float under 1

// The middle of the word-th of 2^32 equal parts of (0,1). As a float its relative precision holds towards 0, so
// unit_float(~word) is one minus this number and precise near its own 0.
inline float unit_float(std::uint32_t word) { return (static_cast<float>(word) + 0.5f) * 0x1p-32f; }

// y = (i + unit(word)) / n, folded. The tail is counted in strata from its own end, never as 1 - y.
inline float folded_stratum(std::uint32_t i, std::uint32_t n, std::uint32_t word) {
    const std::uint32_t mirrored = n - 1 - i;
    const bool lower = (i < mirrored) | ((i == mirrored) & ((word >> 31) == 0));
    const std::uint32_t jitter = word ^ (lower ? 0u : ~0u);  // no branch: half of them would be mispredicted
    const float p = (static_cast<float>(std::min(i, mirrored)) + unit_float(jitter)) / static_cast<float>(n);
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(p) | (static_cast<std::uint32_t>(lower) << 31));
}

// (i + unit(word)) / n, in [0,1).
inline float stratum(std::uint32_t i, std::uint32_t n, std::uint32_t word) {
    return std::min((static_cast<float>(i) + unit_float(word)) / static_cast<float>(n), kBelowOne);
}

}  // namespace strata::sample
