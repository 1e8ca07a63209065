#pragma once

#include <glm/glm.hpp>

#include "src/trace/ray.h"

namespace strata::trace {

// Positions far along a ray are rounded by 2^-52 of their size, a few times at most: a shadow ray is lifted by more.
inline constexpr double kShadowLift = 0x1p-48;

// From a hit of the ray `seen` towards a light: it leaves from the last point known to be outside, so that it does not
// start in the surface it left, with the tolerance of that point. normal and to_light have unit length.
inline Ray shadow_ray(const Ray& seen, const Hit& hit, const glm::dvec3& normal, const glm::dvec3& to_light) {
    Ray ray = seen;
    const double size = glm::length(seen.origin) + glm::length(seen.noise_shift) + hit.s;
    ray.origin += hit.s_outside * seen.direction + kShadowLift * size * normal;
    ray.delta0 += seen.delta_slope * hit.s;
    ray.direction = to_light;
    ray.start = 0.0;
    ray.hint = 0.0f;
    ray.window = nullptr;  // windows are along `seen`
    return ray;
}

}  // namespace strata::trace
