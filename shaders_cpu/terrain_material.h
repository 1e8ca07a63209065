// Terrain: a Lambert surface whose reflectance depends on height and slope, lit by the sun and the sky.
//
//   low, high        reflectance (0..1, linear RGB) of gentle slopes below and above band_height     meadow, snow
//   steep            reflectance of slopes above steep_deg                                           rock
//   band_height      surface units above the base plane or sphere                                    0.25
//   band_width       surface units over which low becomes high, centred on band_height               0.1
//   steep_deg        degrees of slope                                                                38
//   steep_width_deg  degrees over which rock takes over, centred on steep_deg                        12
//
//   [material]
//   low = [0.16, 0.20, 0.07]
//   high = [0.86, 0.88, 0.92]
//   steep = [0.30, 0.26, 0.22]
//   band_height = 0.25
//   band_width = 0.1
//   steep_deg = 38.0
//   steep_width_deg = 12.0
#pragma once

#include <glm/glm.hpp>

#include "src/scene/scene.h"

namespace strata::shaders {

// A point of a surface as its material sees it.
struct SurfacePoint {
    double height = 0.0;          // surface units above the base plane or sphere
    double up_dot_normal = 1.0;   // unit vectors; "up" is the surface's own: away from its base
    double n_dot_sun = 1.0;       // unit vectors; <= 0 faces away
    double sun_visibility = 1.0;  // 0: in shadow, 1: lit
};

// A material under its light.
class TerrainShader {
  public:
    TerrainShader(const scene::Material& material, const scene::Sun& sun, const scene::Sky& sky);

    // Reflectance at a height (surface units) and a slope given by the cosine of the normal to "up" (1: level, 0: a
    // wall, < 0: an overhang, all rock). Cubic blends: a mix of low, high and steep with weights in [0,1] that sum
    // to 1.
    glm::vec3 albedo(double height, double slope_cosine) const;

    // Linear radiance of the point, which is the same in every direction: albedo * (sun + sky). The sun gives
    // colour * intensity * max(0, n.l) * visibility / pi: intensity is the irradiance of a surface that faces it. The
    // sky gives ambient_light() (sky.h), a little more of it to what faces the sun's side and less to what turns away.
    glm::vec3 radiance(const SurfacePoint& point) const;

  private:
    scene::Material material_;
    glm::vec3 low_, rise_, steep_;  // reflectances; rise_ leads from low to high
    glm::dvec3 sun_;                // radiance of white that faces it
    glm::vec3 open_sky_, ground_;   // ambient light where all is sky, or none
    double sunward_sky_;
};

}  // namespace strata::shaders
