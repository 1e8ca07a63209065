// The gradient sky: what a ray sees that meets nothing, and the light that such a sky gives.
//
//   zenith    radiance straight up, linear RGB         0.13 0.28 0.62
//   horizon   radiance level and below, linear RGB   0.62 0.74 0.88
//
//   [sky]
//   zenith = [0.13, 0.28, 0.62]
//   horizon = [0.62, 0.74, 0.88]
//
// The gradient is a chosen one, not a measured sky: horizon has the weight cos^16 of the elevation, which is flat at
// the horizon and half gone 17 degrees above it, as a clear sky looks. "Up" is +y of the given direction: the renderer
// gives directions in the surface's own axes, so that a scene may be turned as a whole.
#pragma once

#include <glm/glm.hpp>

#include "src/scene/scene.h"

namespace strata::shaders {

// Weight of `horizon` in a unit direction whose y is given: 1 at and below the horizon, 0 at the zenith, with a
// continuous slope.
double horizon_weight(double direction_y);

// Linear radiance from a unit direction.
glm::vec3 sky_radiance(const scene::Sky& sky, const glm::dvec3& direction);

// The sky's light on a Lambert surface, as the mean radiance that albedo multiplies, by the cosine of the normal to
// "up": all sky at 1, all ground at -1, in between the mix that two even hemispheres would give. For level ground (1)
// it is the cosine-weighted mean of sky_radiance over the sky. The ground gives back a fifth of that.
glm::vec3 ambient_light(const scene::Sky& sky, double up_dot_normal);

}  // namespace strata::shaders
