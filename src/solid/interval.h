// Stretches of rays, and the parts of a ray inside simple bodies about the origin.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace strata::solid {

// A stretch [begin, end) of a ray; empty when begin >= end. enters_bound: begin lies on a bound that is part of the
// surface (level_set.h).
struct Interval {
    double begin = 0.0;
    double end = 0.0;
    bool enters_bound = false;
};

// Shapes that merely hold the surface are moved outwards by this fraction of the lengths involved, far above the
// rounding of the roots in double.
inline constexpr double kClipSlack = 1e-9;

// Where a ray is below a height: it begins at `height` over the plane and gains `slope` a unit length.
inline Interval clip_below(double top, double height, double slope, double limit) {
    const double padded = top + kClipSlack * (top + std::abs(height));
    if (height > padded) {
        if (slope >= 0.0) return {};
        return {std::min((padded - height) / slope, limit), limit};
    }
    // A ray that leaves a smooth plane from the plane itself still has its first point.
    constexpr double kLeast = std::numeric_limits<double>::min();
    return {0.0, slope > 0.0 ? std::min(limit, std::max((padded - height) / slope, kLeast)) : limit};
}

// In a ball; direction is of unit length.
Interval clip_ball(const glm::dvec3& origin, const glm::dvec3& direction, double radius, double limit);

// In the box |x_i| <= half_i.
Interval clip_box(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& half, double limit);

}  // namespace strata::solid
