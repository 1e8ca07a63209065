// Level water: it mirrors what is over it, by Fresnel's law, and lets its bed be seen where it is shallow. Its waves
// (water_waves.h) are normals alone; it is level as a shape.
//
//   present      whether there is water wherever the ground is below its level          false
//   level_m      its height over the surface's y = 0                                    0
//   wind_m_s     wind that raises its waves; 0: it lies like glass                      3
//   waves_m      length of its longest waves                                            8
//   absorption   1/m: exp(-absorption) is left of light after a metre. Pure water's     0.34 0.06 0.03
//                at 650, 550 and 450 nm, with a little of what is dissolved
//                (R. M. Pope and E. S. Fry, Applied Optics 36, 1997: 0.340, 0.057, 0.009)
//   deep         reflectance of what floats in it, where no bed is seen                 0 0.006 0.008
//
//   [scale]
//   metres = 100.0
//   [water]
//   present = true
//   level_m = -4.0
//   wind_m_s = 2.5
//   absorption = [0.34, 0.06, 0.03]
#pragma once

#include <glm/glm.hpp>

#include "shaders_cpu/water_waves.h"
#include "src/scene/scene.h"

namespace strata::shaders {

class Water {
  public:
    explicit Water(const scene::Scene& scene);

    double level() const { return level_; }  // y, surface units
    const WaterWaves& waves() const { return waves_; }
    const glm::vec3& deep() const { return deep_; }
    bool is_clear() const { return deep_ == glm::vec3(0.0f); }

    // Of light after a way under water, surface units.
    glm::vec3 left_after(double way) const;

    // A way after which a 4096th is left of the clearest colour: what lies beyond is taken to be black. Infinite where
    // water takes nothing.
    double sight() const { return sight_; }

    // Of the light of level water's upper face, what falls on a white bed at a depth, and what the bed's light is worth
    // to an eye over the water that looks along the facet's refracted ray, but for fresnel and the ray's way: both
    // together. Of even light from above, and of a beam from a unit direction; 0 where that is not above.
    glm::vec3 even_light_at(double depth) const;
    glm::vec3 beam_at(const glm::dvec3& to_light, double depth) const;

    // Light that the bed sends up is in part sent back by the face above, and lights the bed anew: by so much more is
    // the light on it than these two say.
    glm::vec3 again_and_again(const glm::vec3& reflectance, double depth) const;

    // Radiance of what floats in it, without fresnel: white is that of a white surface at the level, the bed is seen
    // along a way and lies that deep (both infinite: there is none).
    glm::vec3 own_colour(const glm::vec3& white, double way, double depth) const;

  private:
    double metres_, level_, sight_;
    glm::dvec3 absorption_;  // 1 / surface unit
    glm::vec3 deep_;
    WaterWaves waves_;
};

}  // namespace strata::shaders
