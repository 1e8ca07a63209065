// Bounds of what float arithmetic adds to noise2 and noise3 (noise-inl.h) on every SIMD target: the largest difference
// from exact arithmetic at the position as it was in double, whatever the corners' gradients, for amplitude 1 and in
// lattice units. They bound noise.h's batches too, whose fractions are rounded once likewise. How an octave's position
// came to be rounded to double before it was split into cell and fraction is not part of them.
//
// Derivation, with e = 2^-24, so that a rounding to nearest is off by at most e |x|, and half of that just above a
// power of two:
//   offsets   t - 1 is exact from t = 1/2 on (Sterbenz), below it is off by e/2. Products with the 3-D gradients' 0 and
//             +-1 and sums with 0 are exact, which leaves one rounding a corner's dot product; 2-D has three.
//   fade      with u = t - 1/2 (exact from 1/4 on, else off by e/4), q = 1/4 - u^2: at most 2.2 e, 0.5 e in the
//             middle; its first derivative 5.5 e, its second 30 e.
//   weights   every result is linear in each axis's fade; an error of the fade costs that times the derivative by it,
//             taken of the whole result, where its terms may cancel.
//   interpolation  a + t (b - a) carries the errors of a and b with the weights 1 - t and t; its own roundings cost
//             e |b - a| t twice (difference, product) and e times the result. Every intermediate is linear in the
//             corner gradients, hence no larger than the sum of its corners' parts, and the worst gradients are found
//             corner by corner: the sum over the corners of the largest of (the sum over all roundings of that corner's
//             part).
//   fused multiply-add leaves out the product's rounding and changes nothing else: the bounds are those without.
//   fraction  rounded from double: off by e/2 an axis at most, sqrt(D) e/2 in length; times the bound of the next
//             derivative (bounds.h): 3.25, 12.53, 130.5 e in 3-D and 1.47, 6.36, 67.1 e in 2-D for the value, the
//             gradient and an entry of the Hessian.
// tests/noise/test_float_error_certificate.cpp carries this out for every fraction of the cell, by branch and bound
// over boxes of fractions, and proves the constants. test_float_error.cpp climbs for evaluations that err most; since
// roundings seldom agree it finds a quarter of the bounds in 2-D, in 3-D a fifth of the value's and a tenth of the
// others.
#pragma once

namespace strata::noise {

struct FloatErrors {
    double value;
    double gradient_axis;  // of each component
    double slope;          // of the gradient's length: of the slope along any unit direction
    double hessian_entry;  // of each entry
};

inline constexpr FloatErrors kFloatErrors2 = {12 * 0x1p-24, 50 * 0x1p-24, 57 * 0x1p-24, 245 * 0x1p-24};
inline constexpr FloatErrors kFloatErrors3 = {28 * 0x1p-24, 110 * 0x1p-24, 150 * 0x1p-24, 500 * 0x1p-24};

template <int D>
inline constexpr const FloatErrors& kFloatErrors = D == 2 ? kFloatErrors2 : kFloatErrors3;

}  // namespace strata::noise
