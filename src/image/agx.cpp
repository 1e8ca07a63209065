#include "src/image/agx.h"

#include <algorithm>
#include <cmath>

#include "src/image/luminance.h"

namespace strata::image {
namespace {

// The published curve: its slope at the pivot, mid grey, where it is steepest, and the powers of its two ends.
constexpr double kSlope = 2.0, kToePower = 3.0, kShoulderPower = 3.25;

// The sigmoid's values are what a display of this power is sent.
constexpr double kDisplayPower = 2.2;

// Where mid grey lies on the axis of stops, and the value that a display shows as mid grey: 0.18^(1/2.2). The published
// curve has 0.5 there, which is a quarter of a stop brighter: here exposures mean the same with the curve as without.
constexpr double kPivotX = -kAgxDarkest / (kAgxBrightest - kAgxDarkest);
constexpr double kPivotY = 0.4586564468643811;

// t / (1 + t^p)^(1/p): straight at 0, and 1 far away.
double bend(double t, double power) { return t / std::pow(1.0 + std::pow(t, power), 1.0 / power); }

// The scale s at which s bend(rise / s) is `height`, less than `rise`: (rise/s)^p = (rise/height)^p - 1.
double scale_for(double rise, double height, double power) {
    return rise / std::pow(std::pow(rise / height, power) - 1.0, 1.0 / power);
}

double stops_axis(double light) {
    if (!(light > 0.0)) return 0.0;
    const double stops = std::log2(light / kMidGrey);
    return std::clamp((stops - kAgxDarkest) / (kAgxBrightest - kAgxDarkest), 0.0, 1.0);
}

}  // namespace

Agx::Agx(double contrast)
    : slope_(kSlope * contrast),
      toe_(scale_for(slope_ * kPivotX, kPivotY, kToePower)),
      shoulder_(scale_for(slope_ * (1.0 - kPivotX), 1.0 - kPivotY, kShoulderPower)) {}

double Agx::sigmoid(double x) const {
    const double rise = slope_ * (x - kPivotX);
    const double bent =
        rise < 0.0 ? -toe_ * bend(-rise / toe_, kToePower) : shoulder_ * bend(rise / shoulder_, kShoulderPower);
    return std::clamp(kPivotY + bent, 0.0, 1.0);
}

glm::dvec3 Agx::displayed(const glm::dvec3& light, double saturation) const {
    const double share = glm::dot(kAgxShare, light);
    glm::dvec3 v;
    for (int c = 0; c < 3; ++c) v[c] = sigmoid(stops_axis((1.0 - kAgxInset) * light[c] + share));
    if (saturation != 1.0) v = saturated(v, saturation);
    // The outset undoes the inset: its inverse, by Sherman and Morrison's formula.
    v = (v - glm::dot(kAgxShare, v)) / (1.0 - kAgxInset);
    for (int c = 0; c < 3; ++c) v[c] = std::pow(std::max(v[c], 0.0), kDisplayPower);
    return v;
}

}  // namespace strata::image
