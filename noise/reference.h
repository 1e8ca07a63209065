// The reference path: gradient noise in scalar double, by the definition. Slow, obviously right, and what every faster
// path is held against.
#pragma once

#include <cstdint>

#include "noise/fbm.h"
#include "noise/gradients.h"
#include "noise/hash.h"
#include "noise/interpolate.h"

namespace strata::noise {

// A position split into lattice cell and fraction in [0,1].
template <int D>
struct LatticePoint {
    std::array<std::int64_t, D> cell{};
    Point<D> fraction{};
};

// position in lattice units, |position| < 2^52.
template <int D>
LatticePoint<D> split_position(const Point<D>& position) {
    LatticePoint<D> point;
    for (std::size_t a = 0; a < D; ++a) {
        // Truncation and a correction: std::floor is a library call on the baseline x86-64.
        const auto truncated = static_cast<std::int64_t>(position[a]);
        point.cell[a] = truncated - (position[a] < static_cast<double>(truncated) ? 1 : 0);
        point.fraction[a] = position[a] - static_cast<double>(point.cell[a]);
    }
    return point;
}

// The gradient tables in double, by the selecting bits of a hash.
template <int D>
constexpr auto double_gradients() {
    std::array<std::array<double, D>, D == 2 ? kGradients2.size() : kGradients3.size()> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        for (std::size_t a = 0; a < D; ++a) {
            if constexpr (D == 2) {
                result[i][a] = static_cast<double>(kGradients2[i][a]);
            } else {
                result[i][a] = static_cast<double>(kGradients3[i][a]);
            }
        }
    }
    return result;
}

template <int D>
inline constexpr auto kDoubleGradients = double_gradients<D>();

// The words of the planes below and above a cell on one axis.
inline std::array<std::uint32_t, 2> plane_pair(std::int64_t cell, std::uint32_t key) {
    const std::uint32_t below = plane_word_in_block(cell, block_word(cell, key));
    const bool same_block = static_cast<std::uint32_t>(static_cast<std::uint64_t>(cell) + kCellBias) != 0xFFFFFFFFu;
    const std::uint32_t above =
        same_block ? plane_word_in_block(cell + 1, block_word(cell, key)) : plane_word(cell + 1, key);
    return {below, above};
}

// The gradient that each corner's hash selects, in the table.
template <int D>
std::array<const std::array<double, D>*, (1 << D)> selected_gradients(const LatticeKey& key,
                                                                      const std::array<std::int64_t, D>& cell) {
    std::array<std::array<std::uint32_t, 2>, D> words;
    for (std::size_t a = 0; a < D; ++a) words[a] = plane_pair(cell[a], key.axis[a]);
    std::array<const std::array<double, D>*, (1 << D)> selected;
    for (std::size_t c = 0; c < selected.size(); ++c) {
        std::uint32_t word = 0;
        for (std::size_t a = 0; a < D; ++a) word ^= words[a][(c >> a) & 1];
        selected[c] = &kDoubleGradients<D>[(corner_hash(word) >> kGradientShift) & (kDoubleGradients<D>.size() - 1)];
    }
    return selected;
}

template <int D>
CornerGradients<D> corner_gradients(const LatticeKey& key, const std::array<std::int64_t, D>& cell) {
    const auto selected = selected_gradients<D>(key, cell);
    CornerGradients<D> gradients;
    for (std::size_t c = 0; c < gradients.size(); ++c) gradients[c] = *selected[c];
    return gradients;
}

template <int D>
double reference_value(const LatticeKey& key, const LatticePoint<D>& at) {
    const auto selected = selected_gradients<D>(key, at.cell);
    std::array<double, (1 << D)> ramp;
    for (std::size_t c = 0; c < ramp.size(); ++c) ramp[c] = corner_ramp<D>(*selected[c], at.fraction, c);
    return interpolate_ramps<D>(ramp, at.fraction);
}

template <int D>
Jet<D> reference_jet(const LatticeKey& key, const LatticePoint<D>& at) {
    return interpolate<D>(corner_gradients<D>(key, at.cell), at.fraction);
}

// The octave's position of a point x: w_k x + o_k, in lattice units.
template <int D>
Point<D> octave_position(const Octave& octave, const Point<D>& x) {
    Point<D> p;
    for (std::size_t a = 0; a < D; ++a) p[a] = octave.frequency * x[a] + octave.offset[a];
    return p;
}

}  // namespace strata::noise
