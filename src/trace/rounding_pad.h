// Factors that turn what double arithmetic found into a bound of what is exact.
#pragma once

namespace strata::trace {

// A length, an angle or a tangent times this is no less than the exact one. What it is applied to comes of some dozens
// of roundings and calls of libm, each within a few 2^-53 of its result, and of directions whose length is off by as
// much: together below 1e-13. The rest is spare, for it costs nothing: a beam wider by a billionth steps as far.
inline constexpr double kRoundingPad = 1.0 + 1e-9;

// A distance along rays times this is no more than the exact one, where it comes of a product or a difference or two:
// eight times the 2^-53 of each.
inline constexpr double kSooner = 1.0 - 0x1p-50;

}  // namespace strata::trace
