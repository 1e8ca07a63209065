// Morton codes: of points by the vector, and back. Whatever is sorted by squares uses these.
#pragma once

#include <cstdint>
#include <span>

namespace strata::accel {

// Each out[i] has the bits of the column floor(u[i] * scale) + bias at its even places and those of the row
// floor(v[i] * scale) + bias at its odd ones. Columns and rows are clamped to [0, 2 bias); bias at most 2^31. All
// spans are of a length. The same on every target.
void interleave_columns(std::span<const double> u, std::span<const double> v, double scale, double bias,
                        std::span<std::uint64_t> out);

struct Square {
    std::uint64_t column, row;
};

// The column and the row, of up to 32 bits each, that a Morton code is made of.
Square square_of(std::uint64_t code);

}  // namespace strata::accel
