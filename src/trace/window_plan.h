// How large a window may be, and what its polynomial is off by.
//
// With e = 2^-24 and, over the first K octaves, A0 = sum a, A1 = sum a w G, A2 = sum a w^2 S, A3 = sum a w^3 T (G, S, T
// the bounds of noise/bounds.h), the error in the ball of radius r is at most the sum of
//   - the bounds of the octaves from K on
//   - Taylor's remainder, A3 r^3 / 6
//   - float errors of the octaves' jets, E_value A0 + E_slope r sum a w + 3/2 E_hessian r^2 sum a w^2 (float_error.h; a
//     symmetric 3x3 matrix is no larger than three times its largest entry)
//   - sums over up to 32 octaves, a term of the gradient with at most four roundings, of the Hessian with six:
//     36 e A1 r and 38 e sqrt(3)/2 A2 r^2, less than 54 e A2 r^2; the value's are counted with f's own (trace_plan.h)
//   - evaluation of the polynomial, and of its slope and bend along a ray over up to 2 r: D, the ray's direction and
//     each of some 20 products and sums are rounded once. Terms with the gradient are off by 20 e A1 r at most: 5 in
//     the value, 10 in the slope. Terms with the Hessian, whose entries' absolute values form a matrix no larger than
//     sqrt(3) times its norm, by 80 e A2 r^2: 8 in the value, 35 in the slope, 28 in the bend
//   - the position of the centre, rounded once an octave and axis: sqrt(3) A1 2^-53 |centre + offset / w|, of which
//   four
//     times as much is taken. How rounding displaces centre and ray is not part of it but of the ball's size
//     (src/accel/cell_windows.cpp).
#pragma once

#include <cstdint>
#include <vector>

#include "src/trace/field.h"

namespace strata::trace {

class WindowPlan {
  public:
    explicit WindowPlan(const Field& field);

    struct Size {
        std::uint32_t octaves = 0;  // the coarsest that its polynomial must hold; 0: no window
        double radius = 0.0;
    };

    // How large a window with about this error may be.
    Size size(double error) const;

    // sum a w^3 T / 6, of all octaves.
    double cube() const { return sums_.back().cube; }

    // reach: bound of |centre| on every axis. Holds for a ball one per cent larger as well.
    float error(const Size& size, double reach) const;

  private:
    // Of the octaves before one.
    struct Sums {
        double still = 0.0, linear = 0.0, square = 0.0, cube = 0.0;  // of the error, by powers of the radius
        double inverse_cube = 0.0;
        double slope = 0.0;   // A1
        double offset = 0.0;  // greatest |offset / w| on an axis
        double rest = 0.0;
    };
    std::vector<Sums> sums_;
};

}  // namespace strata::trace
