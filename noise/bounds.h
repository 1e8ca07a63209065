// Worst cases of gradient noise (interpolate.h) with the gradients of gradients.h, over every position, every unit
// direction and every choice of corner gradients. Lengths are in lattice units: an octave a n(w x) has the bounds
// |a| w^k * (bound of order k). They hold for exact arithmetic; rounding of an evaluation comes on top.
//
// Derivation. Fix the position p in the closed cell [0,1]^D and the unit direction d. The k-th derivative of n along d
// is
//
//   sum over corners c of g_c . v_c(p, d),   v_c = d^k/ds^k [W_c(p + s d) (p + s d - c)] at s = 0,
//
// linear in each corner's gradient. Corners choose independently, so its maximum is the sum of sigma(v_c), where
// sigma(v) = max over g of g . v: the sum of the two largest |v_i| for the twelve edges, and
// kGradientLong max|v_i| + kGradientShort min|v_i| for the eight directions. Both sets hold -g with g, so this bounds
// the absolute value too. What remains is a maximum over (p, d), of which the tests give both sides:
// test_bounds.cpp attains it from below by an ascent and an explicit witness, test_bounds_certificate.cpp proves the
// constants from above by branch and bound. The proof uses that sigma is convex and v_c a polynomial: on a box of
// positions times a simplex of directions write v_c in Bernstein form with coefficients b_{c,i}; then
// sum_c sigma(v_c) <= max over i of sum_c sigma(b_{c,i}) (Jensen), which tends to the maximum quadratically in the
// size.
//
//   order        2-D maximum     at p, along d                  3-D maximum     at p, along d
//   value        0.661869741     (0.5, 0.443732)                1.036353811     (0.5, 0.644743, 0.481492)
//   gradient     2.070800781     (0.5, 0.5), axis               3.75            (0.5, 0.5, 0.5), axis
//   second       8.993268758     (0.588884, 0.694425),          14.465145616    (0.600804, 0.600804, 0.5),
//                                (0.843335, 0.537389)                           (-0.581623, 0.581623, -0.568709)
//   third        94.8046875      (0, 0.5), axis across          150.670245869   (0, 0.455074, 0.5), axis across
//
// Across cells n is twice continuously differentiable and the third derivative jumps on faces (`third` bounds it on the
// closed cell, from either side). So along a line s -> n(p + s d), through any number of cells, the slope is Lipschitz
// with constant `second` and the curvature with constant `third`, and the remainders second s^2/2 and third s^3/6 of
// Taylor's formula hold.
#pragma once

namespace strata::noise {

struct NoiseBounds {
    double value;     // max |n|
    double gradient;  // max |grad n|: the Lipschitz constant
    double second;    // max |d^T Hess(n) d|, |d| = 1: the largest absolute eigenvalue
    double third;     // max |d^3/ds^3 n(p + s d)|, |d| = 1
};

// The maxima above, rounded up by less than 1e-4 of themselves.
inline constexpr NoiseBounds kBounds2 = {0.6619, 2.0709, 8.9934, 94.81};
inline constexpr NoiseBounds kBounds3 = {1.0364, 3.7501, 14.466, 150.68};

template <int D>
inline constexpr const NoiseBounds& kNoiseBounds = D == 2 ? kBounds2 : kBounds3;

}  // namespace strata::noise
