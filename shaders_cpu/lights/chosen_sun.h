// Sun: light of a chosen colour from infinitely far.
//
//   direction   towards the sun, in the world, any length                              0.4 0.5 -0.3
//   colour      linear RGB                                                             1.0 0.93 0.82
//   intensity   times colour is the irradiance of a surface that faces it; 0: no sun   2.6
//   shadows     whether the surface shadows itself                                     true
//   angular_radius_deg   of its disc, degrees; softens shadows                         0
//
//   [sun]
//   direction = [0.4, 0.5, -0.3]
//   colour = [1.0, 0.93, 0.82]
//   intensity = 2.6
//   shadows = true
//   angular_radius_deg = 0.0
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <numbers>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/disc_light.h"
#include "shaders_cpu/light_layer.h"
#include "shaders_cpu/shading_point.h"
#include "src/scene/needs.h"

namespace strata::shaders {

class ChosenSun {
  public:
    static constexpr auto kName = "sun";
    static constexpr LightLayer kLayer = LightLayer::sun;

    static bool is_in(const scene::Scene& scene) { return scene.sky.model == scene::SkyModel::gradient; }

    static bool has_part(const scene::Scene& scene) { return scene.sun.intensity > 0.0; }
    static const char* why(const scene::Scene& scene) {
        if (!is_in(scene)) return "sky.model is \"daylight\"";
        return has_part(scene) ? "sun.intensity is above 0" : "sun.intensity is 0: skylight alone";
    }

    explicit ChosenSun(const ShaderInputs& inputs)
        : direction_(glm::normalize(inputs.scene.sun.direction)),
          casts_shadows_(scene::needs_shadow_rays(inputs.scene)),
          radius_(glm::radians(inputs.scene.sun.angular_radius_deg)),
          white_(inputs.scene.sun.colour * (inputs.scene.sun.intensity / std::numbers::pi * disc_factor(radius_))) {}

    const glm::dvec3& direction() const { return direction_; }
    bool casts_shadows() const { return casts_shadows_; }
    double angular_radius() const { return radius_; }

    // colour * intensity * max(0, n.l) / pi.
    glm::vec3 on_white(const ShadingPoint& point) const {
        const double n_dot_sun = std::clamp(glm::dot(point.normal, point.to_light), -1.0, 1.0);
        return glm::vec3(white_ * std::max(n_dot_sun, 0.0));
    }

  private:
    glm::dvec3 direction_;
    bool casts_shadows_;
    double radius_;     // radians
    glm::dvec3 white_;  // radiance of white that faces it
};

}  // namespace strata::shaders
