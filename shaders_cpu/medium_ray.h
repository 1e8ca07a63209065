#pragma once

#include <glm/glm.hpp>

namespace strata::shaders {

// What the eye looks along, by the axes in which the sky lies.
struct MediumRay {
    glm::dvec3 origin;     // surface units
    glm::dvec3 direction;  // of unit length
    double distance;       // surface units; infinite where nothing was hit
};

}  // namespace strata::shaders
