// What the fast tracer prepares from a field: per-octave constants and the bounds of its float arithmetic.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/trace/field.h"

namespace strata::trace {

// Float evaluation of one octave against exact arithmetic, for unit amplitude and any fraction in [0,1]^D. In units of
// e = 2^-24, without fused multiply-add (with it all are smaller):
//   fade: 6t - 15 lies in (-16, -8], one rounding of a product and one of a sum: 8 + 8 e at most; times t and plus 10
//   adds 8 + 8 e; times t^3 at most 2 + 2 e relative: |error| <= 32 e + 4 e = 36 e.
//   value: each fade enters linearly, with the difference of two faces as factor: interpolated along the other axes the
//   ramps are at most t + 1/2 on one and 1 - t + 1/2 on the other, so 3 is ample; on three axes: 324 e; corner ramps
//   (six roundings of at most 2): 12 e; seven interpolations (three roundings of at most 3 on each path of three): 27
//   e; the fraction itself, rounded from double: 3.76 e. Sum 367 e < 2^-15.
inline constexpr double kNoiseFloatError = 0x1p-15;

// The slope along a unit direction: per axis |fade'| <= 1.875 with an error of 12 e times 3; fade' times the error of
// the face difference (two fades, |d2n/dudv| <= 6: 432 e, plus 40 e of rounding): 885 e; the interpolated gradient
// component (three fades, differences <= 2: 216 e, plus 20 e): 1160 e an axis with the 36 e before; times |d|_1 <=
// sqrt 3: 2009 e; the fraction's error through the second derivative: 26 e; frequency and direction as floats: 70 e.
// Sum 2105 e < 2^-12.
inline constexpr double kSlopeFloatError = 0x1p-12;

// Covers up to 64 roundings of 2^-25 and less in a bound's coefficient (a sum over up to 32 octaves) or a root.
inline constexpr double kRoundUp = 1.0 + 0x1p-19;
inline constexpr double kRoundDown = 1.0 - 0x1p-19;

struct TraceOctave {
    double frequency = 0.0;
    std::array<double, 3> offset{};
    std::array<std::uint32_t, 3> key{};
    std::array<std::uint32_t, 3> near_block{};  // block_word of cells within 2^31 of the origin
    float amplitude = 0.0f;
    float wave = 0.0f;  // the frequency, rounded up
    float rest = 0.0f;  // upper bound of the sum of this and all finer octaves
};

struct TracePlan {
    explicit TracePlan(const Field& field);

    std::vector<TraceOctave> octaves;
    float peak = 0.0f;            // bound of |n|, as it comes out in float
    float slope = 0.0f;           // of |dn/ds|, at unit frequency and speed
    float half_bend = 0.0f;       // half the bound of |d2n/ds2|
    float error_relative = 0.0f;  // rounding error of f: error_relative * |base| + error_absolute
    float error_absolute = 0.0f;
    float slope_error = 0.0f;        // of df/ds
    float inverse_lipschitz = 0.0f;  // of f
    float first_hint = 0.0f;         // step length to begin with
};

}  // namespace strata::trace
