#include "shaders_cpu/edge.h"

#include <cmath>
#include <numbers>

namespace strata::shaders {

float edge(const scene::Edge& parameters, int width, int height, double u, double v, double /*t*/) {
    const double angle = parameters.angle_deg * (std::numbers::pi / 180.0);
    const double right = u - 0.5 * width;
    const double up = 0.5 * height - v;  // v points down
    return right * std::cos(angle) + up * std::sin(angle) >= parameters.offset ? 1.0f : 0.0f;
}

}  // namespace strata::shaders
