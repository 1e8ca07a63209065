#pragma once

#include <cmath>
#include <numbers>

namespace strata::shaders {

// Arc cosine of x in [-1, 1], degrees, to 2e-6 degrees: Abramowitz and Stegun 4.4.46.
inline double arc_cosine_deg(double x) {
    const double y = std::abs(x), y2 = y * y, y4 = y2 * y2;
    const double low = 1.5707963050 - 0.2145988016 * y + (0.0889789874 - 0.0501743046 * y) * y2;
    const double high = 0.0308918810 - 0.0170881256 * y + (0.0066700901 - 0.0012624911 * y) * y2;
    const double angle = std::sqrt(1.0 - y) * (low + high * y4) * (180.0 / std::numbers::pi);
    return x < 0.0 ? 180.0 - angle : angle;
}

}  // namespace strata::shaders
