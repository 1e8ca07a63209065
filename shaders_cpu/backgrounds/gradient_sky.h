// The gradient sky (sky.h): two chosen colours.
//
//   [sky]
//   zenith = [0.13, 0.28, 0.62]
//   horizon = [0.62, 0.74, 0.88]
#pragma once

#include <glm/glm.hpp>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/sky.h"

namespace strata::shaders {

class GradientSky {
  public:
    static constexpr auto kName = "gradient sky";

    static bool is_in(const scene::Scene& scene) { return scene.sky.model == scene::SkyModel::gradient; }

    static const char* why(const scene::Scene& scene) {
        return is_in(scene) ? "what rays see that meet nothing: sky.zenith and sky.horizon"
                            : "sky.model is \"daylight\"";
    }

    explicit GradientSky(const ShaderInputs& inputs) : sky_(inputs.scene.sky) {}

    glm::vec3 radiance(const glm::dvec3& direction) const { return sky_radiance(sky_, direction); }
    double gain() const { return 1.0; }

  private:
    scene::Sky sky_;
};

}  // namespace strata::shaders
