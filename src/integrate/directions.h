// Directions by density, from numbers u, v in [0,1). Density and sampling stand together.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace strata::integrate {

// A right-handed orthonormal frame whose z is a unit vector: its columns. Duff, Burgess, Christensen, Hery, Kensler,
// Liani and Villemin, "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
inline glm::dmat3 frame_around(const glm::dvec3& z) {
    const double sign = std::copysign(1.0, z.z);
    const double a = -1.0 / (sign + z.z), b = z.x * z.y * a;
    return {glm::dvec3(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x), glm::dvec3(b, sign + z.y * z.y * a, -z.y),
            z};
}

// In the hemisphere over a unit normal, with density cosine / pi.
inline glm::dvec3 cosine_direction(const glm::dvec3& normal, double u, double v) {
    const double radius = std::sqrt(u), angle = 2.0 * std::numbers::pi * v;
    const glm::dvec3 local(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - u));
    return glm::normalize(frame_around(normal) * local);
}

// Within `radius` radians, at most pi / 2, of a unit axis, evenly by solid angle: density 1 / (2 pi (1 - cos radius)).
// 1 - cosine is formed without cancellation, so that radii of 1e-7 are as even as large ones.
inline glm::dvec3 disc_direction(const glm::dvec3& axis, double radius, double u, double v) {
    const double half = std::sin(0.5 * radius);
    const double less = 2.0 * half * half * u;  // 1 - cosine
    const double sine = std::sqrt(less * (2.0 - less)), angle = 2.0 * std::numbers::pi * v;
    const glm::dvec3 local(sine * std::cos(angle), sine * std::sin(angle), 1.0 - less);
    return glm::normalize(frame_around(axis) * local);
}

}  // namespace strata::integrate
