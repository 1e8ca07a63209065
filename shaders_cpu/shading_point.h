#pragma once

#include <glm/glm.hpp>

namespace strata::shaders {

// A point of a surface as materials and lights see it: in surface units and the surface's own axes, unit vectors.
struct ShadingPoint {
    glm::dvec3 x{0.0};
    glm::dvec3 normal{0.0, 1.0, 0.0};    // outward
    double height = 0.0;                 // above the base plane or sphere
    double up_dot_normal = 1.0;          // "up" is the surface's own: away from its base
    glm::dvec3 to_light{0.0, 1.0, 0.0};  // of the light that is asked, at the time of the sample; materials ignore it
};

}  // namespace strata::shaders
