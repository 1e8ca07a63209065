// A stripe: plane waves of random phase, one a lattice corner, blended by the noise's own weights. At p in lattice
// units, with t = p - cell, corners c in {0,1}^2, weights W_c(t) (products of quintic fades, which add up to 1), phases
// f_c in [0,1) by the corners' hashes and a vector d of length <= 1,
//
//   C + i S = sum over c of W_c(t) exp(2 pi i (bands d . (t - c) + f_c)).
//
// Crests lie across d, `bands` of them a cell. C and S are twice continuously differentiable by p and d.
//
// Bounds, with k = 2 pi bands, from those of the fade u on [0,1]: u' <= 15/8, |u''| <= 5.7736, and
// (1 - u) t^2 + u (1 - t)^2 <= 1/4:
//   sum |grad W_c| <= (15/4) sqrt(2) = 5.304          (each axis: 2 u' times weights that add up to 1)
//   sum W_c |t - c|^2 <= 1/2, so sum W_c |t - c| <= 0.7072
// and, as branch and bound over the cell proves (tests/noise/test_stripe_bounds.cpp), with matrices by Frobenius' norm
//   sum |Hess W_c| <= 19.9,   sum |grad W_c| |t - c| <= 3.76.
// Hence |dC/dp| <= 5.304 + k, |dC/dd| <= 0.7072 k, and the second derivatives by p twice, by p and d, by d twice are at
// most 19.9 + 2 * 5.304 k + k^2,  k (1 + 3.76 + 0.7072 k),  k^2 / 2.  The same holds for S.
#pragma once

namespace strata::noise {

inline constexpr double kStripeSlopes = 5.304;     // sum |grad W_c|
inline constexpr double kStripeBends = 19.9;       // sum |Hess W_c|
inline constexpr double kStripeLevers = 3.76;      // sum |grad W_c| |t - c|
inline constexpr double kStripeDistance = 0.7072;  // sum W_c |t - c|

struct StripeBounds {
    explicit constexpr StripeBounds(double bands)
        : wave(6.283185307179587 * bands),
          by_place(kStripeSlopes + wave),
          by_direction(kStripeDistance * wave),
          place_twice(kStripeBends + 2.0 * kStripeSlopes * wave + wave * wave),
          place_direction(wave * (1.0 + kStripeLevers + kStripeDistance * wave)),
          direction_twice(0.5 * wave * wave) {}

    double wave;  // k
    double by_place, by_direction;
    double place_twice, place_direction, direction_twice;
};

// Of x / R and y / R with R = sqrt(x^2 + y^2 + c^2), components of the unit vector u along P = (x, y, c). While P moves
// along a line by the unit vector d, at the angle a to P, u turns in their plane at the rate sin a / R, which itself
// changes by -2 sin a cos a / R^2. So |u''|^2 = sin^2 a (4 - 3 sin^2 a) / R^4 <= (4/3) / R^4, at sin^2 a = 2/3; and
// |u'| <= 1/R.
inline constexpr double kUnitBend = 1.15471;  // 2 / sqrt(3)

// A corner's phase, by its hash.
inline constexpr int kPhaseShift = 8;
inline constexpr double kPhaseUnit = 0x1p-24;

}  // namespace strata::noise
