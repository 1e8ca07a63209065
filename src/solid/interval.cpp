#include "src/solid/interval.h"

namespace strata::solid {

Interval clip_ball(const glm::dvec3& origin, const glm::dvec3& direction, double radius, double limit) {
    const double middle = -glm::dot(origin, direction);
    const glm::dvec3 nearest = origin + middle * direction;
    const double half_squared = radius * radius - glm::dot(nearest, nearest);
    if (half_squared <= 0.0) return {};
    const double half = std::sqrt(half_squared);
    return {std::max(0.0, middle - half), std::min(limit, middle + half), middle - half > 0.0};
}

Interval clip_box(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& half, double limit) {
    Interval inside{0.0, limit};
    for (int a = 0; a < 3; ++a) {
        if (direction[a] == 0.0) {
            if (std::abs(origin[a]) > half[a]) return {};
            continue;
        }
        const double sign = std::copysign(1.0, direction[a]);
        const double enter = (-sign * half[a] - origin[a]) / direction[a];
        if (enter > inside.begin) {
            inside.begin = enter;
            inside.enters_bound = true;
        }
        inside.end = std::min(inside.end, (sign * half[a] - origin[a]) / direction[a]);
    }
    return inside;
}

}  // namespace strata::solid
