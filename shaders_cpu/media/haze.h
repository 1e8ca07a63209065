// Haze: grey air that takes on the sky's colour in the ray's direction - horizon for level rays - so that a surface far
// away melts into the sky beside it. Beer-Lambert extinction.
//
//   haze_distance  surface units over which 1 - 1/e of the light is lost to haze    0: no haze
//
//   [sky]
//   haze_distance = 60.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/medium_ray.h"
#include "shaders_cpu/medium_segment.h"
#include "shaders_cpu/sky.h"

namespace strata::shaders {

class Haze {
  public:
    static constexpr auto kName = "haze";
    static constexpr bool kBeforeBackground = false;

    static bool is_in(const scene::Scene& scene) {
        return scene.sky.model == scene::SkyModel::gradient && scene.sky.haze_distance > 0.0;
    }

    static const char* why(const scene::Scene& scene) {
        if (is_in(scene)) return "a hit's colour fades into the sky behind it";
        return scene.sky.haze_distance > 0.0 ? "sky.model is \"daylight\"" : "sky.haze_distance is 0";
    }

    explicit Haze(const ShaderInputs& inputs) : sky_(inputs.scene.sky) {}

    // An infinite distance gives the sky alone.
    MediumSegment along(const MediumRay& ray) const {
        const auto clear = static_cast<float>(std::exp(-std::max(ray.distance, 0.0) / sky_.haze_distance));
        return {.transmittance = glm::vec3(clear), .inscatter = sky_radiance(sky_, ray.direction) * (1.0f - clear)};
    }

  private:
    scene::Sky sky_;
};

}  // namespace strata::shaders
