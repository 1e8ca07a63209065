// Light of the gradient sky (sky.h) on the ground: ambient_light(), a little more of it to what faces the sun's side
// and less to what turns away, which gives shape to what lies in shadow. It arrives everywhere, into the deepest gorge;
// sky.light = "rays" is the alternative.
//
//   [sky]
//   zenith = [0.13, 0.28, 0.62]
//   horizon = [0.62, 0.74, 0.88]
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/light_layer.h"
#include "shaders_cpu/shading_point.h"
#include "shaders_cpu/sky.h"
#include "src/scene/needs.h"

namespace strata::shaders {

class GradientAmbient {
  public:
    static constexpr auto kName = "sky light";
    static constexpr LightLayer kLayer = LightLayer::sky;

    static bool is_in(const scene::Scene& scene) {
        return scene.sky.model == scene::SkyModel::gradient && !scene::needs_sky_rays(scene);
    }

    static const char* why(const scene::Scene& scene) {
        if (is_in(scene)) return "the light of the two colours, as if every hit saw all of the sky";
        return scene::needs_sky_rays(scene) ? "sky rays bring it" : "sky.model is \"daylight\"";
    }

    explicit GradientAmbient(const ShaderInputs& inputs)
        : direction_(glm::normalize(inputs.scene.sun.direction)),
          open_sky_(ambient_light(inputs.scene.sky, 1.0)),
          ground_(ambient_light(inputs.scene.sky, -1.0)),
          sunward_(inputs.scene.sun.intensity > 0.0 ? kSunwardSky : 0.0) {}

    const glm::dvec3& direction() const { return direction_; }
    bool casts_shadows() const { return false; }
    double angular_radius() const { return 0.0; }

    glm::vec3 on_white(const ShadingPoint& point) const {
        const double n_dot_sun = std::clamp(glm::dot(point.normal, point.to_light), -1.0, 1.0);
        const auto seen_sky = static_cast<float>(0.5 + 0.5 * std::clamp(point.up_dot_normal, -1.0, 1.0));
        const glm::vec3 even = ground_ * (1.0f - seen_sky) + open_sky_ * seen_sky;
        return even * static_cast<float>(1.0 + sunward_ * n_dot_sun);
    }

  private:
    // Half the difference between the light from the sunward and from the opposite half of the sky, over their mean;
    // chosen.
    static constexpr double kSunwardSky = 0.35;

    glm::dvec3 direction_;         // of the sun
    glm::vec3 open_sky_, ground_;  // where all is sky, or none
    double sunward_;
};

}  // namespace strata::shaders
