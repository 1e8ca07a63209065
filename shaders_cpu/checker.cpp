#include "shaders_cpu/checker.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace strata::shaders {

float checker(const scene::Checker& parameters, int width, int height, double u, double v, double /*t*/) {
    constexpr float kMean = 0.5f;
    constexpr double kCountable = 4503599627370496.0;  // 2^52
    const double below_horizon = v - parameters.horizon * height;
    if (!(below_horizon > 0.0)) return kMean;

    // A ray (u - width/2, -below_horizon, focal) meets y = -height at this multiple of itself.
    const double focal = width;
    const double reach = parameters.height / below_horizon;
    const double column = std::floor((u - 0.5 * width) * reach / parameters.square);
    const double row = std::floor(focal * reach / parameters.square);
    if (!(std::max(std::fabs(column), row) < kCountable)) return kMean;
    const auto parity = static_cast<std::int64_t>(column) + static_cast<std::int64_t>(row);
    return parity % 2 == 0 ? 1.0f : 0.0f;
}

}  // namespace strata::shaders
