// The sun as the Earth's air leaves it, less what mountains out of the picture and clouds take.
//
//   [sky]
//   model = "daylight"
//   [sun]
//   direction = [0.4, 0.1, -0.3]
//   shadow_height = 0.2
//   shadow_relief = 0.1
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/disc_light.h"
#include "shaders_cpu/light_layer.h"
#include "shaders_cpu/shading_point.h"
#include "src/scene/needs.h"

namespace strata::shaders {

class DaylightSun {
  public:
    static constexpr auto kName = "daylight sun";
    static constexpr LightLayer kLayer = LightLayer::sun;

    static bool is_in(const scene::Scene& scene) { return scene.sky.model == scene::SkyModel::daylight; }

    static const char* why(const scene::Scene& scene) {
        return is_in(scene) ? "the sun's light through the air" : "sky.model is \"gradient\"";
    }

    explicit DaylightSun(const ShaderInputs& inputs)
        : daylight_(inputs.daylight),
          clouds_(inputs.clouds),
          direction_(glm::normalize(inputs.scene.sun.direction)),
          casts_shadows_(scene::needs_shadow_rays(inputs.scene)),
          radius_(glm::radians(inputs.scene.sun.angular_radius_deg)),
          disc_(static_cast<float>(disc_factor(radius_))) {}

    const glm::dvec3& direction() const { return direction_; }
    bool casts_shadows() const { return casts_shadows_; }
    double angular_radius() const { return radius_; }
    bool comes_to(const glm::dvec3& x) const { return daylight_->sun_over_ridges(x) > 0.0f; }

    glm::vec3 on_white(const ShadingPoint& point) const {
        const auto n_dot_sun = static_cast<float>(std::max(glm::dot(point.normal, point.to_light), 0.0));
        const glm::vec3 light =
            daylight_->sun_on_white(point.height) * (n_dot_sun * daylight_->sun_over_ridges(point.x) * disc_);
        if (clouds_ == nullptr || n_dot_sun == 0.0f) return light;
        return light * clouds_->sunlight(point.x, point.to_light, point.time);
    }

  private:
    const DaylightScene* daylight_;
    const CloudScene* clouds_;  // null: none
    glm::dvec3 direction_;
    bool casts_shadows_;
    double radius_;  // radians
    float disc_;
};

}  // namespace strata::shaders
