// Where lines meet a layer around the Earth. The ground of a scene is level and has no far end; the layer curves away
// from over it, around a point under the line's own start, so that all places of the ground see the same sky.
#pragma once

#include <cmath>
#include <cstddef>

namespace strata::shaders {

struct CloudCrossings {
    double at[2];  // metres from the start, ascending, above 0
    std::size_t count = 0;

    void add(double s) {
        if (s > 0.0) at[count++] = s;
    }
};

// A line that starts at a radius and climbs by `climb` a metre, and the sphere that is `rise` further out (or, below 0,
// further in). With b = radius * climb, s^2 + 2 b s = rise (2 radius + rise).
inline CloudCrossings cloud_crossings(double radius, double climb, double rise) {
    CloudCrossings crossings;
    const double b = radius * climb, d = rise * (2.0 * radius + rise), inside = b * b + d;
    if (!(inside > 0.0)) return crossings;
    // Of the two solutions the one without cancellation; their product is -d.
    const double far = b > 0.0 ? -b - std::sqrt(inside) : std::sqrt(inside) - b;
    const double near = -d / far;
    crossings.add(far < near ? far : near);
    crossings.add(far < near ? near : far);
    return crossings;
}

}  // namespace strata::shaders
