// The sky that sunlight makes of the Earth's air (daylight/daylight.h), without the sun's disc.
//
//   [sky]
//   model = "daylight"
#pragma once

#include <glm/glm.hpp>

#include "shaders_cpu/closed_list.h"

namespace strata::shaders {

class DaylightSky {
  public:
    static constexpr auto kName = "daylight sky";

    static bool is_in(const scene::Scene& scene) { return scene.sky.model == scene::SkyModel::daylight; }

    static const char* why(const scene::Scene& scene) {
        return is_in(scene) ? "what rays see that meet nothing: the Earth's air in sunlight, by tables of 0.2 s"
                            : "sky.model is \"gradient\"";
    }

    explicit DaylightSky(const ShaderInputs& inputs) : daylight_(inputs.daylight) {}

    glm::vec3 radiance(const glm::dvec3& direction) const { return daylight_->sky(direction); }
    double gain() const { return daylight_->gain(); }
    glm::dvec3 sample(double u, double v) const { return daylight_->tables().sample_sky(u, v).direction; }
    double pdf(const glm::dvec3& direction) const { return daylight_->tables().sky_pdf(direction); }

  private:
    const DaylightScene* daylight_;
};

}  // namespace strata::shaders
