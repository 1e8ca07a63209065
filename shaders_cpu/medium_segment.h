#pragma once

#include <glm/glm.hpp>

namespace strata::shaders {

// What a stretch of a medium does to light: radiance beyond it is seen as radiance * transmittance + inscatter.
struct MediumSegment {
    glm::vec3 transmittance{1.0f};
    glm::vec3 inscatter{0.0f};

    glm::vec3 over(const glm::vec3& radiance) const { return radiance * transmittance + inscatter; }
};

}  // namespace strata::shaders
