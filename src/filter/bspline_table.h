// Bulk inversion of the B-spline's distribution function, in float, by table.
//
// Probabilities are folded and signed: |q| in [0,1/2] is the probability of the tail that ends at the coordinate, the
// sign bit says which tail (clear: upper, result >= 0; set: lower, result <= 0). So q keeps its relative precision in
// both tails, and q = -0.0f and +0.0f are the two ends of the support. For y uniform in [0,1], q = -y or 1 - y.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/filter/bspline_table_simd.h"

namespace strata::filter {

class BsplineTable {
  public:
    // m in [kMinOrder, kMaxOrder]. Under a millisecond; orders above kMaxTableOrder build no table.
    explicit BsplineTable(int m);

    int order() const { return order_; }

    // The least |q| that the table answers; below it (and at any q above kMaxTableOrder) the exact inverse does.
    float table_floor() const { return table_floor_; }

    // x - m/2 in px, where x has the tail probability q. Absolute error <= kTableError for m <= kMaxTableOrder;
    // above, the exact inverse rounded to float. |q| > 1/2 and NaN count as 1/2: the centre.
    float centred(float q) const;

    // The same for every element; bit for bit the same on one SIMD target, whatever the neighbours. The spans have
    // equal length and do not overlap.
    void centred(std::span<const float> q, std::span<float> x) const;

  private:
    float exact(float q) const;

    int order_;
    std::int32_t first_cell_ = 0;
    std::int32_t last_cell_ = 0;
    float table_floor_;
    std::vector<detail::Cubic> cubics_;
};

inline constexpr int kMaxTableOrder = 32;
inline constexpr double kTableError = 1e-6;  // px

}  // namespace strata::filter
