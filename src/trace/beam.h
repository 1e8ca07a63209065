// Bundles of rays traced at once: how far all of them are free.
#pragma once

#include <glm/glm.hpp>

namespace strata::trace {

// The points within radius0 + spread * s of the axis point origin + s direction, s >= 0; direction is of unit length.
// Up to `start` the bundle is known to be free of the surface. Noise is evaluated at x + n with n no further than
// noise_radius from noise_shift.
struct Beam {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, 1.0};
    glm::dvec3 noise_shift{0.0};
    double radius0 = 0.0;
    double spread = 0.0;  // at least 0
    double noise_radius = 0.0;
    double start = 0.0;
    double limit = 0.0;
    float hint = 0.0f;  // step length to begin with; 0: unknown
};

// Of the bundle as the noise sees it.
inline double radius_at(const Beam& beam, double s) { return beam.radius0 + beam.noise_radius + beam.spread * s; }

struct BeamEnd {
    double s = 0.0;       // f > 0 at every point of the bundle with axis coordinate in [start, s)
    float hint = 0.0f;    // step length to go on with
    float slope = 0.0f;   // of f along the axis near s, about
    bool misses = false;  // the bundle is free up to its limit
    float f = 0.0f;       // on the axis at s, about; 0: unknown
};

}  // namespace strata::trace
