// The B-spline inversion as the paper has it, kept for comparison: plain recursion and plain Newton-Raphson. Gamito &
// Maddock, "Anti-aliasing with stratified B-spline filters of arbitrary degree", Computer Graphics Forum 25(2), 2006.
// For anything but comparison use bspline.h: this costs O(2^m), needs many iterations in the tails and may fail.
#pragma once

namespace strata::filter::paper {

// N_m(x) by (A.8): N_m(x) = x/m N_{m-1}(x) + (1 - x/m) N_{m-1}(x-1), N_1(x) = clamp(x, 0, 1). O(2^m).
double cdf(int m, double x);

// n_m(x) by (13c): n_m(x) = N_{m-1}(x) - N_{m-1}(x-1); n_1 is 1 on [0,1). O(2^m).
double pdf(int m, double x);

struct PaperInversion {
    double x = 0;  // the last finite iterate
    int iterations = 0;
    bool converged = false;  // false where n_m vanished or the iterations ran out
};

inline constexpr double kTolerance = 1e-6;  // px
inline constexpr int kMaxIterations = 1000;

// The x with N_m(x) = y by Newton-Raphson from x = m/2, until a step is shorter than tolerance (px). Where it
// converges slowly (y near 0 or 1) the error left is up to about m times the tolerance.
PaperInversion inverse_cdf(int m, double y, double tolerance = kTolerance, int max_iterations = kMaxIterations);

// The same iteration on the values of bspline.h, O(m^2): for orders where the recursion takes too long.
PaperInversion inverse_cdf_fast(int m, double y, double tolerance = kTolerance, int max_iterations = kMaxIterations);

}  // namespace strata::filter::paper
