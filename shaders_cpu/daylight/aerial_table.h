// The air between one observer and what is seen.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "shaders_cpu/daylight/air_light.h"
#include "shaders_cpu/daylight/sky_frame.h"

namespace strata::shaders {

// Light that arrives is transmittance * radiance + inscatter.
struct AerialPerspective {
    glm::dvec3 transmittance{1.0};  // of the three channels
    glm::dvec3 inscatter{0.0};      // cd/m^2, linear Rec.709
};

// The integral itself, from any height. Some microseconds.
AerialPerspective integrate_aerial(const AirLight& light, double height, double sun_up, const SkyDirection& direction,
                                   double distance);

// The same for one observer, tabulated by direction and distance: transmittance within 0.03, in-scatter within 5 % of
// the sky's brightest. Distances lie close at the observer, who must be in dense air himself: up to kHighest.
class AerialTable {
  public:
    static constexpr double kHighest = 10e3;

    AerialTable(const AirLight& light, const SkyFrame& frame);

    AerialPerspective at(const AirModel& medium, const SkyDirection& direction, double distance) const;

  private:
    struct Node {
        float transmittance[4], even[4], lobe[4];  // RGB and nothing
    };
    void add_line(const AirLight& light, const SkyFrame& frame, const AirPath& path, double cosine);

    double horizon_;
    std::vector<Node> nodes_;  // by up, azimuth, distance
};

}  // namespace strata::shaders
