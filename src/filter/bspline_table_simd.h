// The SIMD kernel of BsplineTable: one cubic a cell, the cell chosen by the float's bits.
#pragma once

#include <cstddef>
#include <cstdint>

namespace strata::filter::detail {

// A cell is an eighth of an octave: the sign-free bits of a float above the kCellShift lowest ones.
inline constexpr int kCellShift = 20;

// In t in [-1/2,1/2) across the cell, constant term first.
inline constexpr int kCoefficients = 4;
struct alignas(16) Cubic {
    float coefficients[kCoefficients];
};

struct CubicTable {
    const Cubic* cubics;
    std::int32_t first_cell;  // (bits of |q|) >> kCellShift of the first cell
    std::int32_t last_cell;
};

// x[i] = cubic of q[i]'s cell at q[i], with the sign of q[i]; cells beyond either end count as the end. Returns whether
// any q[i] lies before the first cell.
bool evaluate_cubics(const CubicTable& table, const float* q, std::size_t count, float* x);

}  // namespace strata::filter::detail
