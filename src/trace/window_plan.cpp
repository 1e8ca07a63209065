#include "src/trace/window_plan.h"

#include <algorithm>
#include <cmath>

#include "noise/bounds.h"
#include "noise/float_error.h"

namespace strata::trace {

namespace {

constexpr double kUnit = 0x1p-24;

// Covers the rounding of steps in float, 2^-24 of the ball's size.
constexpr double kLarger = 1.01;

}  // namespace

WindowPlan::WindowPlan(const Field& field) : sums_(field.octaves().size() + 1) {
    const noise::NoiseBounds& bounds = field.is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
    const noise::FloatErrors& errors = field.is_planar_noise() ? noise::kFloatErrors2 : noise::kFloatErrors3;
    for (std::size_t k = 0; k < field.octaves().size(); ++k) {
        const noise::Octave& octave = field.octaves()[k];
        const double a = octave.amplitude, w = octave.frequency;
        Sums sums = sums_[k];
        sums.still += errors.value * a;
        sums.linear += a * w * (errors.slope + 56.0 * kUnit * bounds.gradient);
        sums.square += a * w * w * (1.5 * errors.hessian_entry + 134.0 * kUnit * bounds.second);
        sums.cube += a * w * w * w * bounds.third / 6.0;
        sums.inverse_cube = 1.0 / sums.cube;
        sums.slope += a * w * bounds.gradient;
        for (const double offset : octave.offset) sums.offset = std::max(sums.offset, std::abs(offset) / w);
        sums_[k + 1] = sums;
    }
    for (std::size_t k = field.octaves().size(); k-- > 0;) {
        sums_[k].rest = sums_[k + 1].rest + field.octaves()[k].amplitude * bounds.value;
    }
}

WindowPlan::Size WindowPlan::size(double error) const {
    Size best;
    for (std::size_t k = sums_.size(); k-- > 1;) {
        const double left = error - sums_[k].still - sums_[k].rest;
        if (left <= 0.0) break;
        const double cube = left * sums_[k].inverse_cube;
        if (cube > best.radius) best = {static_cast<std::uint32_t>(k), cube};
    }
    best.radius = std::cbrt(best.radius);
    return best;
}

float WindowPlan::error(const Size& size, double reach) const {
    const Sums& sums = sums_[size.octaves];
    const double r = size.radius * kLarger;
    const double position = 2.0 * sums.slope * 0x1p-52 * (reach + sums.offset) * 1.7320508075688773;
    const double error = sums.still + r * (sums.linear + r * (sums.square + r * sums.cube)) + sums.rest + position;
    return static_cast<float>(error * (1.0 + 0x1p-19));
}

}  // namespace strata::trace
