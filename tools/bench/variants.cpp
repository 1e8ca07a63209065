#include "tools/bench/variants.h"

#include <fmt/format.h>

#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"

namespace strata::tools::bench {

namespace {

constexpr double kHalfFrame_s = 0.02;  // at 25 frames a second
constexpr int kFlyoverFrame = 120;     // in full flight

// Seeds whose 16 blocks are like the whole frame: of 60,000 tried those for which the mean evaluations a ray (with
// shadow rays and without), the share of hits and the mean logarithm of their distance come nearest to the frame's
// (within 1.7 %, mostly 0.6 %), and so, with a quarter of the weight, do the jumps in depth. 16 blocks at random are
// off by some 12 %. `--only subset` tells how well they serve the engine as it is.
constexpr BlockSeeds kHyperterrainBlocks{8893, 54252, 41526};
constexpr BlockSeeds kPlanarBlocks{16608, 10170, 33461};
constexpr BlockSeeds kTerrainBlocks{16057, 18520, 7113};
constexpr BlockSeeds kIsosurfaceBlocks{1674, 45880, 3441};
constexpr BlockSeeds kPlanetBlocks{8266, 28643, 22270};
constexpr BlockSeeds kFlyoverBlocks{59552, 29557, 11164};

scene::Scene builtin(const char* name) { return scene::read_scene(scene::find_builtin(name)->text, name); }

scene::Scene planet_scene(double spin_deg_per_s, double open_s) {
    scene::Scene scene = builtin("planet");
    scene.surface.spin_deg_per_s = spin_deg_per_s;
    scene.shutter.open_s = open_s;
    return scene;
}

scene::Scene flyover_scene(double open_s) {
    scene::Scene scene = builtin("flyover");
    scene.shutter.frame = kFlyoverFrame;
    scene.shutter.open_s = open_s;
    return scene;
}

}  // namespace

Variant hyperterrain() { return {"hyperterrain", builtin("hyperterrain"), kHyperterrainBlocks}; }

Variant hyperterrain_octaves(int octaves) {
    Variant variant = hyperterrain();
    if (octaves == variant.scene.surface.octaves) return variant;
    variant.name += fmt::format(", {} octaves", octaves);
    variant.scene.surface.octaves = octaves;
    return variant;
}

Variant hyperterrain_planar() {
    Variant variant = hyperterrain();
    variant.name += ", 2-D noise";
    variant.scene.surface.kind = solid::kKind<solid::HeightField>;
    variant.block_seeds = kPlanarBlocks;
    return variant;
}

Variant hyperterrain_shadows() {
    Variant variant = hyperterrain();
    variant.name += ", shadows";
    variant.scene.sun.shadows = true;
    return variant;
}

Variant hyperterrain_shared() {
    Variant variant = hyperterrain();
    variant.name += ", shared-sobol";
    variant.scene.sampling.estimator = scene::EstimatorKind::shared_sobol;
    return variant;
}

Variant terrain() { return {"terrain", builtin("terrain"), kTerrainBlocks}; }

Variant isosurface() {
    Variant variant{"isosurface", builtin("isosurface"), kIsosurfaceBlocks};
    variant.scene.shutter.open_s = 0.0;
    return variant;
}

Variant planet() { return {"planet", planet_scene(0.0, 0.0), kPlanetBlocks}; }
Variant planet_turning() { return {"planet, turning", planet_scene(72.0, kHalfFrame_s), kPlanetBlocks}; }
Variant flyover() { return {"flyover", flyover_scene(0.0), kFlyoverBlocks}; }
Variant flyover_moving() { return {"flyover, moving", flyover_scene(kHalfFrame_s), kFlyoverBlocks}; }

}  // namespace strata::tools::bench
