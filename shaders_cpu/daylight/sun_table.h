// What is left of sunlight anywhere in the air.
#pragma once

#include <vector>

#include "shaders_cpu/daylight/air_path.h"

namespace strata::shaders {

// Irradiance of a plane that faces the sun, relative to outside the atmosphere: by light that met nothing, and by that
// together with what haze sent on almost straight (see AirModel).
struct Sunlight {
    Bands full, diffuse;
};

// At `height`, with the middle of the sun at `sun_up`, the cosine to the vertical. The disc sets gradually: what shows
// of it above the sphere's horizon shines through the air as its centroid does.
Sunlight sunlight(const AirModel& medium, double height, double sun_up);

// The same, tabulated.
class SunTable {
  public:
    explicit SunTable(const AirModel& medium);

    static Cell height_cell(double height);

    // `horizon` is horizon_up() of the height that the cell is for.
    Sunlight at(const Cell& height, double horizon, double sun_up) const;

  private:
    struct Node {
        float light[8];  // full, then diffuse
    };
    std::vector<Node> nodes_;  // by height, then by sun_up
};

}  // namespace strata::shaders
