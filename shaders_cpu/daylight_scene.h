// Daylight (shaders_cpu/daylight) over a scene's ground: from surface units to metres, and from cd/m^2 to the scene's
// radiance.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "noise/fbm.h"
#include "shaders_cpu/daylight/daylight.h"
#include "shaders_cpu/medium_segment.h"
#include "src/scene/scene.h"

namespace strata::shaders {

// Luminance that radiance 1 stands for, cd/m^2: about what white ground under a high sun has, so that daylight and
// chosen lights want like exposures.
inline constexpr double kLuminanceOfOne = 25'000.0;

class DaylightScene {
  public:
    // to_sun, eye: in the surface's resting axes, the eye in surface units.
    DaylightScene(const scene::Scene& scene, const glm::dvec3& to_sun, const glm::dvec3& eye);

    // Of the sky in a unit direction.
    glm::vec3 sky(const glm::dvec3& direction) const;

    // What a white Lambert surface shows at a height (surface units): under a sun that it faces, and under the whole
    // sky and ground for a unit normal.
    glm::vec3 sun_on_white(double height) const;

    // The part of the sun that mountains out of the picture leave at a point of the surface: sun.shadow_height. Their
    // ridge line is a noise across the sun's direction.
    float sun_over_ridges(const glm::dvec3& x) const;
    glm::vec3 sky_on_white(const glm::dvec3& normal) const;

    // The air from the eye on; distance in surface units.
    MediumSegment air_along(const glm::dvec3& direction, double distance) const;

    double gain() const { return gain_; }
    const Daylight& tables() const { return daylight_; }

  private:
    double metres_, altitude_, gain_;
    scene::Sun sun_;
    glm::dvec3 across_;  // level, across the sun's direction
    std::vector<noise::Octave> ridges_;
    Daylight daylight_;
};

}  // namespace strata::shaders
