#include "src/scene/water_keys.h"

#include <fmt/format.h>

#include "src/scene/camera_path.h"
#include "src/scene/key_makers.h"
#include "src/scene/key_text.h"
#include "src/scene/needs.h"
#include "src/scene/scene_error.h"

namespace strata::scene {

Section describe_water(Water& water, bool matters) {
    using namespace key_makers;
    constexpr Range kHeight{-1e5, 1e5}, kWind{0.0, 20.0}, kWaves{0.01, 1e4}, kAbsorption{0.0, 1e4};
    const bool present = water.present;
    return section(
        "water", "level water: mirrors what is over it, shows its bed where that is near", matters,
        {plain("present", water.present, "whether there is water wherever the ground is below its level"),
         only_if(present, number("level_m", water.level_m, kHeight, "m", "its height over the surface's y = 0")),
         only_if(present, number("wind_m_s", water.wind_m_s, kWind, "m/s",
                                 "wind 12 m over it, which raises waves of Cox and Munk's slopes; below 1 hardly any, "
                                 "0: it lies like glass")),
         only_if(present, number("waves_m", water.waves_m, kWaves, "m", "length of its longest waves")),
         only_if(present, vector("absorption", water.absorption, kAbsorption, "1/m, red, green, blue",
                                 "what a metre of water takes of light: exp(-absorption) is left; pure water's")),
         only_if(present, colour("deep", water.deep, kReflectance,
                                 "reflectance of what floats in it, where no bed is seen: its own colour"))});
}

namespace {

// Water lies level as gravity says, so a surface under it does not lean.
void check_level(const Scene& scene) {
    const Surface& surface = scene.surface;
    const solid::KindRow& kind = solid::row_of(surface.kind);
    if (!kind.is_level) {
        throw SceneError(fmt::format("water.present: water lies level, a {} does not, allowed: false here", kind.name));
    }
    if (surface.spin_deg_per_s != 0.0) {
        throw SceneError(
            "water.present: water stands still over a surface that does not, allowed: surface.spin_deg_per_s = 0, or "
            "false here");
    }
    if (surface.rotation_deg.x != 0.0 || surface.rotation_deg.z != 0.0) {
        throw SceneError(
            "water.present: water lies level over a surface that leans, allowed: surface.rotation_deg = [0, any, 0], "
            "or false here");
    }
}

}  // namespace

void check_water(const Scene& scene) {
    if (!needs_water(scene)) return;
    check_level(scene);
    const double level = scene.surface.origin.y + scene.surface.scale * scene.water.level_m / scene.scale.metres;
    for (const glm::dvec3& x : CameraPath(scene.camera).position_hull(open_shutter(scene))) {
        if (x.y > level) continue;
        throw SceneError(fmt::format(
            "camera.position: is not above the water (y = {} there, water.level_m is at {} in the world), allowed: an "
            "eye above it, or water.present = false",
            number_text(x.y), number_text(level)));
    }
}

}  // namespace strata::scene
