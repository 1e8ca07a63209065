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
    double time = 0.0;                   // seconds; where clouds drift

    // Of materials that look so near (DetailedMaterial in materials/all.h).
    double footprint = 0.0;       // side of a square as large as what a pixel sees of the surface, surface units
    glm::dvec3 noise_shift{0.0};  // noise is read at x + noise_shift
    glm::dvec3 up{0.0, 1.0, 0.0};
};

// What a point does with light, of a material that is not Lambert's everywhere.
struct SurfaceLook {
    glm::vec3 reflectance;   // linear RGB in [0,1]
    double roughness = 0.0;  // of rough_lobe.h, in [0,1]
};

}  // namespace strata::shaders
