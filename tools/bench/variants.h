// The fixed scenes of the benchmark. Their work is compared across versions: no value here may change.
#pragma once

#include <string>

#include "src/scene/scene.h"
#include "tools/bench/subset.h"

namespace strata::tools::bench {

struct Variant {
    std::string name;
    scene::Scene scene;
    BlockSeeds block_seeds{};
};

Variant hyperterrain();
Variant hyperterrain_octaves(int octaves);
Variant hyperterrain_planar();   // a height field: the same octaves of 2-D noise
Variant hyperterrain_shadows();  // a shadow ray a lit hit
Variant hyperterrain_shared();   // the estimator that scenes have by default

Variant terrain();     // 12 octaves of 2-D noise, shadows, haze
Variant isosurface();  // 6 octaves in a ball, shadows; at rest

Variant planet();          // 12 octaves, shadows; at rest
Variant planet_turning();  // 72 degrees a second, the shutter open for half of a frame's time
Variant flyover();         // the camera at an instant of its path
Variant flyover_moving();  // and while the shutter is open

}  // namespace strata::tools::bench
