#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace strata::solid {

// What holds all that is solid, in the surface's coordinates: a ball about the origin, the half-space under a plane, or
// neither.
struct Extent {
    double ball = std::numeric_limits<double>::infinity();  // its radius
    glm::dvec3 up{0.0};  // of unit length: all lies where up . x <= the relief's amplitude; 0: there is no such plane
};

}  // namespace strata::solid
