#pragma once

#include <glm/glm.hpp>

namespace strata::shaders {

// What the eye looks along, by the axes in which the sky lies.
struct MediumRay {
    glm::dvec3 origin;      // surface units
    glm::dvec3 direction;   // of unit length
    double distance;        // surface units; infinite where nothing was hit
    double pixel = 0.0;     // side of a pixel at distance 1, surface units
    double time = 0.0;      // seconds; where clouds drift
    glm::vec3 shaft{0.0f};  // sunlight that fog sends along it to the eye, where that is found by a ray (Fog::shaft)
};

}  // namespace strata::shaders
