#include "src/trace/trace_plan.h"

#include <algorithm>
#include <cmath>

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "src/trace/relief_plan.h"

namespace strata::trace {

namespace {

// What the slope along a ray is off by for the factors in front of an octave's: the octave's wave number, rounded up by
// 2^-19; roundings of wave number, amplitude, their product, the direction, and four of the product of direction and
// gradient. Relative to the bound of the slope.
constexpr double kSlopeFactors = (kRoundUp - 1.0) + 8 * 0x1p-24;

float round_up(double x) { return static_cast<float>(x * kRoundUp); }

}  // namespace

TraceOctave prepare_octave(const noise::Octave& octave) {
    TraceOctave result;
    result.frequency = octave.frequency;
    result.offset = octave.offset;
    result.key = octave.key.axis;
    for (std::size_t a = 0; a < 3; ++a) result.near_block[a] = noise::block_word(0, octave.key.axis[a]);
    result.amplitude = static_cast<float>(octave.amplitude);
    result.wave = round_up(octave.frequency);
    return result;
}

TracePlan::TracePlan(const Field& field) {
    const noise::NoiseBounds& bounds = field.is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
    const noise::FloatErrors& errors = field.is_planar_noise() ? noise::kFloatErrors2 : noise::kFloatErrors3;
    peak = round_up(bounds.value + errors.value);  // M - v must not fall short because v is a float
    slope = round_up(bounds.gradient);
    half_bend = round_up(0.5 * bounds.second);
    double total = 0.0, slopes = 0.0, rest = 0.0;
    for (const noise::Octave& octave : field.octaves()) {
        octaves.push_back(prepare_octave(octave));
        total += octave.amplitude;
        slopes += octave.amplitude * octave.frequency;
    }
    for (std::size_t k = octaves.size(); k-- > 0;) {
        rest += field.octaves()[k].amplitude * bounds.value;
        octaves[k].rest = round_up(rest);
    }
    // Sums of base and octaves: each of fewer than 4 K + 16 roundings is at most 2^-24 of |base| + twice the
    // amplitudes.
    const double roundings = 0x1p-24 * static_cast<double>(4 * octaves.size() + 16);
    error_relative = round_up(roundings);
    error_absolute = round_up(errors.value * total + roundings * 2.0 * field.amplitude());
    slope_error = round_up(errors.slope * slopes + (roundings + kSlopeFactors) * field.lipschitz());
    inverse_lipschitz = static_cast<float>(1.0 / std::max(field.lipschitz(), 1e-30));
    if (field.relief_plan() != nullptr) {
        first_hint = field.relief_plan()->first_hint;
        return;
    }
    first_hint = octaves.empty() ? 1.0f : static_cast<float>(0.15 / octaves.front().frequency);
}

}  // namespace strata::trace
