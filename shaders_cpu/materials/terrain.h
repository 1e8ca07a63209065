// Terrain: a Lambert surface whose reflectance depends on height and slope.
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

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/shading_point.h"

namespace strata::shaders {

class TerrainMaterial {
  public:
    static constexpr auto kName = "terrain material";

    static bool is_in(const scene::Scene& /*scene*/) { return true; }

    static const char* why(const scene::Scene& scene) {
        return scene.ground.empty() ? "colour by height and slope: [material]" : "[[ground]] stands for [material]";
    }

    explicit TerrainMaterial(const ShaderInputs& inputs) : TerrainMaterial(inputs.scene.material) {}
    explicit TerrainMaterial(const scene::Material& material);

    glm::vec3 reflectance(const ShadingPoint& point) const { return albedo(point.height, point.up_dot_normal); }

    // Reflectance at a height (surface units) and a slope given by the cosine of the normal to "up" (1: level, 0: a
    // wall, < 0: an overhang, all rock). Cubic blends: a mix of low, high and steep with weights in [0,1] that sum
    // to 1.
    glm::vec3 albedo(double height, double slope_cosine) const;

    // How much of the point is above band_height, and how much is steep: the weights of these blends, in [0,1].
    double height_mask(const ShadingPoint& point) const;
    double slope_mask(const ShadingPoint& point) const;

  private:
    float high(double height) const;
    float steepness(double slope_cosine) const;

    scene::Material material_;
    glm::vec3 low_, rise_, steep_;  // reflectances; rise_ leads from low to high
};

}  // namespace strata::shaders
