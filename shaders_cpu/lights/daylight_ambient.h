// Light of the daylight sky, and of the ground below its horizon, on a surface. It arrives everywhere; sky.light =
// "rays" is the alternative. Clouds are in it at their mean, as if the sky had the same veil all over.
//
//   gain   1 is true, more is a photographer's fill   1
//
//   [sky]
//   model = "daylight"
//   gain = 1.0
#pragma once

#include <glm/glm.hpp>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/light_layer.h"
#include "shaders_cpu/shading_point.h"
#include "src/scene/needs.h"

namespace strata::shaders {

class DaylightAmbient {
  public:
    static constexpr auto kName = "daylight sky light";
    static constexpr LightLayer kLayer = LightLayer::sky;

    static bool is_in(const scene::Scene& scene) {
        return scene.sky.model == scene::SkyModel::daylight && !scene::needs_sky_rays(scene);
    }

    static const char* why(const scene::Scene& scene) {
        if (is_in(scene)) return "the light of the daylight sky, as if every hit saw all of the sky";
        return scene::needs_sky_rays(scene) ? "sky rays bring it" : "sky.model is \"gradient\"";
    }

    explicit DaylightAmbient(const ShaderInputs& inputs)
        : daylight_(inputs.daylight), clouds_(inputs.clouds), direction_(glm::normalize(inputs.scene.sun.direction)) {}

    const glm::dvec3& direction() const { return direction_; }
    bool casts_shadows() const { return false; }
    double angular_radius() const { return 0.0; }
    glm::vec3 on_white(const ShadingPoint& point) const {
        return clouds_ == nullptr ? daylight_->sky_on_white(point.normal) : clouds_->sky_on_white(point.normal);
    }

  private:
    const DaylightScene* daylight_;
    const CloudScene* clouds_;  // null: none
    glm::dvec3 direction_;      // of the sun
};

}  // namespace strata::shaders
