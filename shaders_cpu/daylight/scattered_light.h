// Light that has been scattered at least once, anywhere in the air.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "shaders_cpu/daylight/sun_table.h"

namespace strata::shaders {

// Mean radiance over all directions, and irradiance of level ground at the sphere's surface, by the height and the
// sun's `up`. The first scattering is by direction, all later ones and the ground send light everywhere evenly; nothing
// else is approximated: each order is the integral of the one before over the shell, which matters at twilight, when a
// point's surroundings are lit quite differently from itself.
class ScatteredLight {
  public:
    // What follows the last of `orders` scatterings is added as a geometric series, or left out.
    enum class Rest { kSeries, kNone };
    ScatteredLight(const AirModel& medium, const SunTable& sun, int orders, Rest rest);

    static Cell height_cell(double height);

    Bands mean_radiance(const Cell& height, double sun_up) const;
    Bands ground_irradiance(double sun_up) const;

  private:
    // One value for each sun of one height, or of the ground.
    using Row = std::vector<glm::vec4>;
    struct Field {
        std::vector<Row> mean;  // by height
        Row ground;
    };
    class Gatherer;

    static Field no_light();
    void add(const Field& order, const Field& before, bool with_rest);

    Field sum_;
};

}  // namespace strata::shaders
