// B-spline weights at the speed of sampling: all m pixels that see a position, along one axis, in a few multiplications
// a pixel.
#pragma once

#include <cstddef>
#include <vector>

namespace strata::estimate {

class BsplineWeights {
  public:
    // m in [1,100].
    explicit BsplineWeights(int m);

    int order() const { return m_; }

    // A position in screen cell c is seen by pixels within `reach` of c, and a pixel sees the cells within it.
    int reach() const { return m_ / 2; }

    // The weights n_m(u - (j + 1/2) + m/2) of the m pixels j = c + first .. c + first + m - 1 that see u = c +
    // fraction, fraction in [0,1). Returns `first`. Never negative; absolute error <= kWeightError.
    int at_fraction(float fraction, double* weights) const;

    // The same, not yet evaluated: weights[k] = max(0, c[k] + s (c[S + k] + s (c[2 S + k] + s c[3 S + k]))), where
    // S = stride() and c is readable for k < S. Evaluate in this order to get the same bits.
    struct Cubics {
        int first;
        const double* c;
        double s;
    };
    Cubics lookup(float fraction) const {
        // u - (j + 1/2) + m/2 = piece + f: for even m the pieces join at pixel centres, for odd m at pixel borders.
        const bool even = m_ % 2 == 0;
        const bool right_half = fraction >= 0.5f;
        const double shift = even ? (right_half ? -0.5 : 0.5) : 0.0;
        const double scaled = (static_cast<double>(fraction) + shift) * cells_;
        const int cell = static_cast<int>(scaled);
        return {((even & right_half) ? 1 : 0) - reach(), &cubics_[4 * stride() * static_cast<std::size_t>(cell)],
                scaled - cell};
    }

    // m rounded up, so that eight lanes never read past a row.
    std::size_t stride() const { return (static_cast<std::size_t>(m_) + 7) / 8 * 8; }

    // n_m(x) to the same error; zero outside [0,m].
    double at(double x) const;

  private:
    void tabulate(int cell);

    int m_;
    int cells_;  // of [0,1], each with one cubic for every piece of the spline
    // [cell][power][k < stride]: coefficients in s in [0,1) of the cubic for piece m - 1 - k, k ascending with the
    // pixel.
    std::vector<double> cubics_;
};

// Cubic interpolation from values and derivatives errs by at most max |n_m''''| / 384 / cells^4; |n_m''''| <= 6,
// reached at m = 5. For m <= 4 a cubic is exact and this is rounding.
inline constexpr int kWeightCells = 64;
inline constexpr double kWeightError = 6.0 / 384 / (1.0 * kWeightCells * kWeightCells * kWeightCells * kWeightCells);

}  // namespace strata::estimate
