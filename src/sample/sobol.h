// The two-dimensional Sobol sequence, a (0,2)-sequence in base 2: any 2^k points that begin at a multiple of 2^k put
// one point in each of the 2^k boxes of every shape 2^-a x 2^-(k-a). Owen scrambling keeps that and makes it unbiased.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace strata::sample {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0F0F0F0Fu) | ((x & 0x0F0F0F0Fu) << 4);
    x = ((x >> 8) & 0x00FF00FFu) | ((x & 0x00FF00FFu) << 8);
    return (x >> 16) | (x << 16);
}

// Point `index` of the unscrambled sequence, as 32-bit fractions. The first coordinate is van der Corput's, the second
// belongs to the primitive polynomial x + 1 (Sobol' 1967), whose direction numbers are Pascal's triangle modulo 2.
constexpr std::array<std::uint32_t, 2> sobol_point(std::uint32_t index) {
    std::uint32_t second = 0;
    std::uint32_t direction = 0x80000000u;
    for (std::uint32_t rest = index; rest != 0; rest >>= 1) {
        if ((rest & 1u) != 0) second ^= direction;
        direction ^= direction >> 1;
    }
    return {reverse_bits(index), second};
}

// Nested uniform scrambling by a hash in which a bit is moved only by the bits above it in the fraction, that is, below
// it in the reversed word: Laine & Karras, "Stratified sampling for stochastic transparency", 2011; Burley, "Practical
// hash-based Owen scrambling", JCGT 9(4), 2020; multipliers of N. Vegdahl, "Building a better LK hash", 2021.
// Takes the fraction's bits reversed, gives them in order.
constexpr std::uint32_t owen_scramble_reversed(std::uint32_t reversed, std::uint32_t seed) {
    std::uint32_t x = reversed;
    x ^= x * 0x3D20ADEAu;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return reverse_bits(x);
}

// The first n points with their bits reversed: what each pixel scrambles anew. The first coordinate reversed is the
// index itself, so only the second is kept.
class SobolTable {
  public:
    explicit SobolTable(std::uint32_t n);

    std::uint32_t size() const { return static_cast<std::uint32_t>(second_reversed_.size()); }
    std::uint32_t scrambled_u(std::uint32_t index, std::uint32_t seed) const {
        return owen_scramble_reversed(index, seed);
    }
    std::uint32_t scrambled_v(std::uint32_t index, std::uint32_t seed) const {
        return owen_scramble_reversed(second_reversed_[index], seed);
    }

  private:
    std::vector<std::uint32_t> second_reversed_;
};

}  // namespace strata::sample
