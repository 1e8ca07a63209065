#include "shaders_cpu/wheel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strata::shaders {
namespace {

double fraction(double x) { return x - std::floor(x); }

bool on_spoke(const scene::Wheel& parameters, double turn, double t) {
    const double pitches = parameters.spokes * (turn - parameters.turns_per_s * t);
    return fraction(pitches + 0.5 * parameters.spoke_fill) < parameters.spoke_fill;
}

}  // namespace

float wheel(const scene::Wheel& parameters, int width, int height, double u, double v, double t) {
    constexpr float kBlack = 0.0f;
    constexpr float kWhite = 1.0f;
    const double edge = 0.5 * std::min(width, height);
    const double right = (u - 0.5 * width) / edge;
    const double up = (0.5 * height - v) / edge;  // v points down
    const double radius = std::hypot(right, up);
    if (radius > kWheelRadius) return kWhite;
    if (radius > kWheelRimInside || radius < kWheelHubRadius) return kBlack;
    const double turn = std::atan2(up, right) / (2.0 * std::numbers::pi);
    return on_spoke(parameters, turn, t) ? kBlack : kWhite;
}

}  // namespace strata::shaders
