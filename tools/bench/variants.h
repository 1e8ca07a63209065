// The fixed scenes of the benchmark. Their work is compared across versions: no value here may change.
#pragma once

#include <cstdint>
#include <string>

#include "src/scene/scene.h"

namespace strata::tools::bench {

struct Variant {
    std::string name;
    scene::Scene scene;
    std::uint64_t block_seed = 1;  // for subset_of(), see variants.cpp
};

// hyperterrain's block_seed for 64 px of a frame of 3840x2160. Its blocks of 128 px are those of 64 px of 1920x1080.
inline constexpr std::uint64_t kHyperterrainSeed4k = 5732;

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
