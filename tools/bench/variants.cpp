#include "tools/bench/variants.h"

#include <fmt/format.h>

#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"

namespace strata::tools::bench {

namespace {

constexpr double kHalfFrame_s = 0.02;  // at 25 frames a second
constexpr int kFlyoverFrame = 120;     // in full flight

// Seeds whose 45 blocks of 64 px of the 1920x1080 frame are like all of it: of 150,000 tried those for which the mean
// evaluations a ray (with shadow rays and without), the share of hits and the mean logarithm of their distance come
// nearest to the frame's (0.5 % at most), and so do jumps in depth (1 %). 45 blocks at random are off by some 8 %.
constexpr std::uint64_t kHyperterrainSeed = 98165;
constexpr std::uint64_t kPlanarSeed = 50843;
constexpr std::uint64_t kTerrainSeed = 40754;
constexpr std::uint64_t kIsosurfaceSeed = 48992;
constexpr std::uint64_t kPlanetSeed = 135511;
constexpr std::uint64_t kFlyoverSeed = 2755;

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

Variant hyperterrain() { return {"hyperterrain", builtin("hyperterrain"), kHyperterrainSeed}; }

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
    variant.scene.surface.kind = scene::SurfaceKind::terrain;
    variant.block_seed = kPlanarSeed;
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

Variant terrain() { return {"terrain", builtin("terrain"), kTerrainSeed}; }

Variant isosurface() {
    Variant variant{"isosurface", builtin("isosurface"), kIsosurfaceSeed};
    variant.scene.shutter.open_s = 0.0;
    return variant;
}

Variant planet() { return {"planet", planet_scene(0.0, 0.0), kPlanetSeed}; }
Variant planet_turning() { return {"planet, turning", planet_scene(72.0, kHalfFrame_s), kPlanetSeed}; }
Variant flyover() { return {"flyover", flyover_scene(0.0), kFlyoverSeed}; }
Variant flyover_moving() { return {"flyover, moving", flyover_scene(kHalfFrame_s), kFlyoverSeed}; }

}  // namespace strata::tools::bench
