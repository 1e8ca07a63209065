#include "shaders_cpu/ramp.h"

#include <cmath>
#include <numbers>

namespace strata::shaders {

float ramp(const scene::Ramp& parameters, int width, int height, double u, double v, double /*t*/) {
    const double angle = parameters.angle_deg * (std::numbers::pi / 180.0);
    const double right = u - 0.5 * width;
    const double up = 0.5 * height - v;  // v points down
    return static_cast<float>(0.5 + parameters.rise / width * (right * std::cos(angle) + up * std::sin(angle)));
}

}  // namespace strata::shaders
