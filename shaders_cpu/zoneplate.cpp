#include "shaders_cpu/zoneplate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strata::shaders {

float zoneplate(const scene::Zoneplate& parameters, int width, int height, double u, double v, double /*t*/) {
    const double edge = 0.5 * std::min(width, height);
    const double rings = parameters.rings > 0.0 ? parameters.rings : edge / 4.0;
    const double x = (u - 0.5 * width) / edge;
    const double y = (v - 0.5 * height) / edge;
    const double periods = rings * (x * x + y * y);
    const double phase = 2.0 * std::numbers::pi * (periods - std::floor(periods));
    return static_cast<float>(0.5 + 0.5 * std::cos(phase));
}

}  // namespace strata::shaders
