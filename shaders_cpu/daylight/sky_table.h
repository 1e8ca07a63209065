// The sky of one observer in all directions.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "shaders_cpu/daylight/air_light.h"
#include "shaders_cpu/daylight/sky_frame.h"

namespace strata::shaders {

// Split at the horizon, where the sky jumps to the ground, and finest there; linear in the cosine of the azimuth from
// the sun, in which an even and smooth function of the azimuth is smooth.
class SkyTable {
  public:
    SkyTable(const AirLight& light, const SkyFrame& frame);

    // Linear Rec.709, cd/m^2, without the sun's disc. Never negative.
    glm::dvec3 radiance(const AirModel& medium, const SkyDirection& direction) const;

    double horizon() const { return horizon_; }

  private:
    struct Node {
        float even[4], lobe[4];  // RGB and nothing
    };
    double horizon_;
    std::vector<Node> nodes_;  // above, then below the horizon; by up, then by azimuth
};

}  // namespace strata::shaders
