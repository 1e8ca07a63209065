// Lattice hash. A cell index is an int64 per axis; the hash of a cell is
//
//   biased = index + 2^31,  lo = low 32 bits, hi = high 32 bits        (so that cells near 0 share one hi)
//   block  = mix32(hi ^ key[axis])                                     (constant over 2^32 cells)
//   s      = lo ^ block,  t = (s ^ (s >> 16)) * kAxisMultiplier
//   word   = t ^ (t >> 15)                                             (one a plane of the lattice)
//   hash   = (word_x ^ word_y [^ word_z]) * kCornerMultiplier          (one a corner; bits 24.. select the gradient)
//
// No period: the multiplication takes words apart by their carries, so that word(c + P) ^ word(c) is constant for no
// P != 0. The shift by 16 before it is needed: without, a flip of a high bit of lo passes through the multiplication
// without a carry, changes word by a constant, and a shift by (2^31, 2^31, 0) cancels it. A shift that changes hi
// replaces block by another value of a bijection of hi.
#pragma once

#include <array>
#include <cstdint>

namespace strata::noise {

inline constexpr std::uint32_t kAxisMultiplier = 0x9E3779B1u;    // prime next to 2^32 / golden ratio
inline constexpr std::uint32_t kCornerMultiplier = 0x85EBCA77u;  // xxHash's second 32-bit prime
inline constexpr int kWordShift = 16;
inline constexpr int kAxisShift = 15;
inline constexpr int kGradientShift = 24;
inline constexpr std::uint64_t kCellBias = 0x80000000u;

// A bijection of 32 bits with low bias (C. Wellons, "Hash function prospector", constants of lowbias32).
constexpr std::uint32_t mix32(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7FEB352Du;
    x ^= x >> 15;
    x *= 0x846CA68Bu;
    x ^= x >> 16;
    return x;
}

// The finaliser of SplitMix64 (Steele, Lea & Flood 2014): a bijection of 64 bits.
constexpr std::uint64_t mix64(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

// What makes one octave's lattice different from another's.
struct LatticeKey {
    std::array<std::uint32_t, 3> axis{};
};

constexpr std::uint64_t octave_key(std::uint64_t seed, int octave) {
    return mix64(mix64(seed) + static_cast<std::uint64_t>(octave) * 0x9E3779B97F4A7C15u);
}

constexpr LatticeKey lattice_key(std::uint64_t seed, int octave) {
    LatticeKey key;
    for (std::uint64_t a = 0; a < 3; ++a) {
        key.axis[a] = static_cast<std::uint32_t>(mix64(octave_key(seed, octave) + a + 1) >> 32);
    }
    return key;
}

constexpr std::uint32_t block_word(std::int64_t index, std::uint32_t key) {
    return mix32(static_cast<std::uint32_t>((static_cast<std::uint64_t>(index) + kCellBias) >> 32) ^ key);
}

constexpr std::uint32_t plane_word_in_block(std::int64_t index, std::uint32_t block) {
    const auto lo = static_cast<std::uint32_t>(static_cast<std::uint64_t>(index) + kCellBias);
    const std::uint32_t s = lo ^ block;
    const std::uint32_t t = (s ^ (s >> kWordShift)) * kAxisMultiplier;
    return t ^ (t >> kAxisShift);
}

// The hash word of a lattice plane.
constexpr std::uint32_t plane_word(std::int64_t index, std::uint32_t key) {
    return plane_word_in_block(index, block_word(index, key));
}

constexpr std::uint32_t corner_hash(std::uint32_t combined_words) { return combined_words * kCornerMultiplier; }

}  // namespace strata::noise
