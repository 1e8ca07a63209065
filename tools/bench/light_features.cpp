#include "tools/bench/light_features.h"

#include <functional>
#include <string>

#include "src/scene/builtin.h"
#include "src/scene/toml_reader.h"

namespace strata::tools::bench {

namespace {

using scene::Scene;
using Change = std::function<void(Scene&)>;

constexpr double kSunRadius_deg = 0.2666;
constexpr double kMetresAUnit = 1000.0;

// Hills with 12 octaves, a gradient for a sky, no haze, and a sun that throws no shadows: primary rays alone.
Scene bare_hills() {
    Scene scene = scene::read_scene(scene::find_builtin("hills")->text, "hills");
    scene.scale.metres = kMetresAUnit;
    scene.sky = {};
    scene.sun.shadows = false;
    scene.sun.angular_radius_deg = 0.0;
    return scene;
}

Variant with(Variant variant, const char* what, const Change& change) {
    variant.name = std::string("hills, ") + what;
    change(variant.scene);
    return variant;
}

void add_clouds(Scene& scene) {
    scene.clouds = {{.name = "cumulus", .altitude_m = 2500.0, .coverage = 0.5, .size_m = 4000.0}};
}

void add_fog(Scene& scene) { scene.fog = {.visibility_m = 3000.0, .fall_m = 100.0, .rise_m = 50.0}; }

void add_water(Scene& scene, double wind_m_s) {
    scene.water.present = true;
    scene.water.wind_m_s = wind_m_s;
}

void add_ground(Scene& scene) {
    scene::GroundLayer rock, snow;
    rock.name = "rock";
    rock.roughness = 0.5;
    rock.tone = 0.5;
    snow.name = "snow";
    snow.colour = glm::dvec3(0.8);
    snow.slope_deg.to = 35.0;
    snow.slope_noise_deg = 5.0;
    scene.ground = {rock, snow};
}

}  // namespace

std::vector<LightFeature> light_features() {
    const Variant bare{"hills, gradient sky", bare_hills()};
    const Variant daylight = with(bare, "daylight", [](Scene& s) { s.sky.model = scene::SkyModel::daylight; });
    const Variant hard = with(daylight, "shadows", [](Scene& s) { s.sun.shadows = true; });
    const Variant soft = with(hard, "soft sun", [](Scene& s) { s.sun.angular_radius_deg = kSunRadius_deg; });
    const Variant sky = with(soft, "sky rays", [](Scene& s) {
        s.sky.light = scene::SkyLight::rays;
        s.sky.bounces = 0;
    });
    const Variant bounce = with(sky, "bounce", [](Scene& s) { s.sky.bounces = 1; });
    const Variant afar = with(hard, "shadow from afar", [](Scene& s) {
        s.sun.shadow_height = 0.2;
        s.sun.shadow_relief = 0.1;
    });
    const Variant foggy = with(hard, "fog", add_fog);
    const Variant shafts = with(foggy, "shafts", [](Scene& s) { s.fog.shafts = true; });
    const Variant cloudy = with(hard, "clouds", add_clouds);
    const Variant layered = with(hard, "ground layers", add_ground);
    const Variant calm = with(hard, "calm water", [](Scene& s) { add_water(s, 0.0); });
    const Variant waves = with(hard, "waves", [](Scene& s) { add_water(s, 5.0); });
    return {{"daylight: sky, sun and air", bare, daylight},
            {"shadows, of a point", daylight, hard},
            {"soft sun, against a point", hard, soft},
            {"sky rays", soft, sky},
            {"one bounce", sky, bounce},
            {"sun, sky and bounce rays", daylight, bounce},
            {"shadow from afar", hard, afar},
            {"fog", hard, foggy},
            {"shafts in fog", foggy, shafts},
            {"a layer of clouds", hard, cloudy},
            {"two ground layers, rough", hard, layered},
            {"water, calm", hard, calm},
            {"waves on it", calm, waves}};
}

}  // namespace strata::tools::bench
