// Uniform B-splines of order m = 1..100 (degree m - 1): density, distribution function and its inverse, in double.
//
// n_m is the density of the sum of m independent uniform numbers of [0,1): support [0,m], mean m/2, variance m/12.
// Equations (9c), (13c) and (A.8) are those of Gamito & Maddock, "Anti-aliasing with stratified B-spline filters of
// arbitrary degree", Computer Graphics Forum 25(2), 2006. Lengths are in pixels. Everything is evaluated on the half
// x <= m/2 and mirrored, where every term of the recurrence is positive: nothing cancels at any order.
//
// The order must be in [kMinOrder, kMaxOrder]; this is asserted, not reported. NaN in gives NaN out.
#pragma once

namespace strata::filter {

inline constexpr int kMinOrder = 1;
inline constexpr int kMaxOrder = 100;

// n_m(x). Zero outside [0,m); n_1 is 1 on [0,1). Relative error <= 16 eps where the result is a normal number.
double bspline_pdf(int m, double x);

// N_m(x), the integral of n_m from 0 to x. Relative error <= 16 eps where the result is a normal number.
double bspline_cdf(int m, double x);

// 1 - N_m(x), to the same relative error.
double bspline_survival(int m, double x);

// The x in [0,m/2] with N_m(x) = p, for p in [0,1/2]; p beyond is clamped. Absolute error <= kInverseError.
// A coordinate of the upper half is m - bspline_inverse_tail(m, p), p being its survival probability.
double bspline_inverse_tail(int m, double p);

// The x in [0,m] with N_m(x) = y, for y in [0,1]; y beyond is clamped. Absolute error <= kInverseError.
double bspline_inverse_cdf(int m, double y);

// The same, with the number of Halley steps it took (0 where a closed form holds).
struct Inversion {
    double x = 0;
    int iterations = 0;
};
Inversion bspline_invert(int m, double y);

// A Halley step of s px with |s| <= 1e-5 leaves the inversion an error of at most kHalleyCubic |s|^3 px. The factor is
// the largest |(g''/2g')^2 - g'''/6g'| of g = N_m^(1/m) over [1,m/2] and all orders, 1 at m = 3, x = 1+, and a margin.
inline constexpr double kHalleyCubic = 1.1;  // 1/px^2

// px; verified for every order against 400-bit arithmetic, where at most 9e-15 is seen.
inline constexpr double kInverseError = 1e-13;

}  // namespace strata::filter
