// The Earth's air as the eye looks through it: it dims and reddens what is far, and adds the blue of distance.
//
//   visibility_km  at sea level, where 2 % of the contrast is left   80
//   altitude_m     of the surface's y = 0 over the sea               500
//
//   [scale]
//   metres = 100.0
//   [sky]
//   model = "daylight"
//   visibility_km = 80.0
//   altitude_m = 500.0
#pragma once

#include <glm/glm.hpp>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/medium_ray.h"
#include "shaders_cpu/medium_segment.h"

namespace strata::shaders {

class DaylightAir {
  public:
    static constexpr auto kName = "daylight air";
    static constexpr bool kBeforeBackground = false;

    static bool is_in(const scene::Scene& scene) { return scene.sky.model == scene::SkyModel::daylight; }

    static const char* why(const scene::Scene& scene) {
        return is_in(scene) ? "the air between, by sky.visibility_km" : "sky.model is \"gradient\"";
    }

    explicit DaylightAir(const ShaderInputs& inputs) : daylight_(inputs.daylight) {}

    MediumSegment along(const MediumRay& ray) const { return daylight_->air_along(ray.direction, ray.distance); }

  private:
    const DaylightScene* daylight_;
};

}  // namespace strata::shaders
