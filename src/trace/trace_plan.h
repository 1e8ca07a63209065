// What the fast tracer prepares from a field: per-octave constants and the bounds of its float arithmetic (of one
// octave's noise: noise/float_error.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/trace/field.h"

namespace strata::trace {

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

// All but `rest`, which is 0.
TraceOctave prepare_octave(const noise::Octave& octave);

struct TracePlan {
    // Of a field whose relief_plan() is made.
    explicit TracePlan(const Field& field);

    std::vector<TraceOctave> octaves;
    float peak = 0.0f;            // bound of |n|, as it comes out in float
    float slope = 0.0f;           // of |dn/ds|, at unit frequency and speed
    float half_bend = 0.0f;       // half the bound of |d2n/ds2|
    float error_relative = 0.0f;  // rounding error of f: error_relative * |base| + error_absolute
    float error_absolute = 0.0f;
    float slope_error = 0.0f;        // of df/ds, its octaves summed up in float along a float direction
    float inverse_lipschitz = 0.0f;  // of f
    float first_hint = 0.0f;         // step length to begin with
};

}  // namespace strata::trace
