#include "tests/golden/scenes.h"

#include "src/scene/override.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"
#include "tests/golden/scene_keys.h"

namespace strata::golden {

namespace {

// Past an instant in the middle, when the shutter is open.
Keys camera_keys(const std::string& from, const std::string& to) {
    return {"camera.keys=[{time_s=0.2,position=" + from + "},{time_s=0.4,position=" + to +
            ",fov_deg=40},{time_s=0.9}]"};
}

const std::string kTwoClouds = R"([[clouds]]
name = "low"
altitude_m = 900.0
coverage = 0.5
size_m = 700.0
warp_m = 90.0
[[clouds]]
name = "high"
altitude_m = 7000.0
depth = 1.0
size_m = 9000.0
stretch = 4.0
)";

std::vector<GoldenScene> grounds() {
    const Keys flight = camera_keys("[0,1.2,0]", "[0.5,1.1,1]");
    return {
        {.name = "terrain", .keys = kTerrain},
        {.name = "terrain_1_octave", .keys = kTerrain + kOneOctave},
        {.name = "terrain_16_octaves", .keys = kTerrain + kSixteenOctaves},
        {.name = "terrain_no_shadows", .keys = kTerrain + kNoShadows + kStratified},
        {.name = "terrain_camera_keys", .keys = kTerrain + kShutter + flight},
        {.name = "terrain_drift", .keys = kTerrain + kShutter + Keys{"surface.drift=[3,0,2]", "sampling.time_order=3"}},
        {.name = "terrain_crop", .keys = kTerrain + kStratified, .crop = film::Rect{10, 5, 28, 17}},
        {.name = "terrain_passes", .keys = kTerrain + kStratified + Keys{"sampling.N=1"}, .passes = 4},
        {.name = "terrain_aov", .keys = kTerrain, .channels = kCosts},
        {.name = "terrain_layers", .keys = kTerrain + kStratified, .channels = kLight},
        {.name = "terrain_many_rays",
         .keys = kTerrain + Keys{"sampling.N=8", "surface.octaves=5", "sampling.tolerance=1"},
         .crop = film::Rect{8, 9, 24, 17}},
        {.name = "terrain_noon", .keys = kTerrain + Keys{"sun.direction=[0,1,0]", "sampling.tolerance=0.01"}},
        {.name = "terrain_night", .keys = kTerrain + Keys{"sun.direction=[0.4,-0.2,1]", "sampling.tolerance=1"}},
        {.name = "terrain_reference",
         .keys = kTerrain + Keys{"surface.octaves=4", "sampling.N=1", "sky.haze_distance=0"},
         .tracer = integrate::Tracer::reference},
        {.name = "hyperterrain", .keys = kHyperterrain + kStratified},
        {.name = "hyperterrain_1_octave", .keys = kHyperterrain + kOneOctave},
        {.name = "hyperterrain_16_octaves", .keys = kHyperterrain + kSixteenOctaves},
        {.name = "hyperterrain_drift", .keys = kHyperterrain + kShutter + Keys{"surface.drift=[1,2,-1]"}},
        {.name = "hyperterrain_aov", .keys = kHyperterrain + kNoShadows + kStratified, .channels = kCosts},
        {.name = "hyperterrain_camera_keys",
         .keys = kHyperterrain + kShutter + camera_keys("[0.3,0.9,0]", "[0.5,1.1,0.4]") +
                 Keys{"camera.interpolation=linear"}},
        {.name = "hyperterrain_rotated",
         .keys = kHyperterrain + Keys{"surface.rotation_deg=[10,40,-15]", "surface.origin=[0.1,-0.4,2]"}},
    };
}

std::vector<GoldenScene> bodies() {
    const Keys spin{"surface.spin_deg_per_s=72", "surface.spin_axis=[0.2,1,0.1]"};
    return {
        {.name = "planet", .keys = kPlanet},
        {.name = "planet_1_octave", .keys = kPlanet + kOneOctave + kStratified},
        {.name = "planet_16_octaves", .keys = kPlanet + kSixteenOctaves},
        {.name = "planet_spin", .keys = kPlanet + kShutter + spin + Keys{"sampling.time_order=4"}},
        {.name = "planet_passes", .keys = kPlanet + kNoShadows + Keys{"sampling.N=1"}, .passes = 3},
        {.name = "planet_shared_crop", .keys = kPlanet + Keys{"sampling.m=3"}, .crop = film::Rect{8, 4, 25, 16}},
        {.name = "isosurface", .keys = kIsosurface},
        {.name = "isosurface_1_octave", .keys = kIsosurface + kOneOctave},
        {.name = "isosurface_16_octaves", .keys = kIsosurface + kSixteenOctaves + kStratified},
        {.name = "isosurface_box_aov",
         .keys = kIsosurface + Keys{"surface.bound=box", "surface.bound_size=[1.5,1,1.2]"},
         .channels = kCosts},
        {.name = "planet_geometry",
         .keys = kPlanet + kShutter + spin + camera_keys("[0.5,1,-6]", "[1,1.2,-5.5]"),
         .channels = kGeometry},
        {.name = "planet_variance_crop",
         .keys = kPlanet + Keys{"sampling.estimator=random"},
         .crop = film::Rect{8, 4, 25, 16},
         .channels = {"variance", "samples", "N"}},
        {.name = "isosurface_all_motion",
         .keys = kIsosurface + kShutter + spin + camera_keys("[0,2,-5]", "[1,2.2,-4.5]") +
                 Keys{"surface.drift=[0.5,1,0]", "sampling.estimator=sobol"}},
    };
}

// Numbers so large or small that float cannot tell where the surface is, and double decides.
std::vector<GoldenScene> extremes() {
    return {
        {.name = "earth_in_metres",
         .keys = kPlanet + Keys{"surface.radius=6.371e6", "surface.frequency=1e-5", "surface.octaves=18",
                                "surface.amplitude=3000", "camera.far=1e8", "camera.position=[0,6.771e6,0]",
                                "camera.look_at=[0,5.9e6,2e6]", "sun.direction=[1,0.05,0.1]"}},
        {.name = "terrain_far_away",
         .keys = kTerrain + Keys{"surface.origin=[1e7,0,-1e7]", "sampling.tolerance=1e-6", "surface.octaves=12"}},
        {.name = "terrain_micrometres",
         .keys = kTerrain + Keys{"surface.scale=1e-6", "camera.position=[0,1.2e-6,0]",
                                 "camera.look_at=[1e-6,0.75e-6,6e-6]", "camera.far=2e-4"}},
        {.name = "terrain_finest_cells",
         .keys =
             kTerrain + Keys{"surface.frequency=1e9", "surface.octaves=8", "surface.lacunarity=3", "camera.far=60"}},
        {.name = "hyperterrain_steep",
         .keys = kHyperterrain + Keys{"surface.amplitude=40", "surface.frequency=0.3", "camera.position=[0.3,60,0.1]",
                                      "camera.look_at=[0.3,0,40]", "camera.far=1e4"}},
        {.name = "isosurface_telescope",
         .keys = kIsosurface + Keys{"camera.position=[4e3,8e3,-2e4]", "camera.far=1e5", "camera.fov_deg=0.01"}},
    };
}

// The estimators and orders that the scenes above leave out, over surfaces and over pictures that trace nothing.
std::vector<GoldenScene> estimators() {
    const auto by = [](const std::string& estimator, int N, int m) {
        return Keys{"sampling.estimator=" + estimator, "sampling.N=" + std::to_string(N),
                    "sampling.m=" + std::to_string(m)};
    };
    const auto pattern = [&](const std::string& image) {
        return Keys{"film.width=24", "film.height=14", "image=" + image};
    };
    return {
        {.name = "none_terrain_aov", .keys = kTerrain + by("none", 1, 1), .channels = kCosts},
        {.name = "super_hyperterrain", .keys = kHyperterrain + by("super", 2, 4)},
        {.name = "jittered_isosurface", .keys = kIsosurface + by("jittered", 2, 3)},
        {.name = "random_planet_aov", .keys = kPlanet + by("random", 2, 6), .channels = kCosts},
        {.name = "none_zoneplate", .keys = pattern("zoneplate") + by("none", 1, 1)},
        {.name = "super_zoneplate", .keys = pattern("zoneplate") + by("super", 3, 1)},
        {.name = "uniform_zoneplate", .keys = pattern("zoneplate") + by("uniform", 3, 2)},
        {.name = "jittered_checker", .keys = pattern("checker") + by("jittered", 3, 4)},
        {.name = "stratified_checker", .keys = pattern("checker") + by("stratified", 3, 15)},
        {.name = "random_edge", .keys = pattern("edge") + by("random", 3, 8)},
        {.name = "sobol_edge", .keys = pattern("edge") + by("sobol", 3, 1)},
        {.name = "shared_ramp", .keys = pattern("ramp") + by("shared", 2, 2)},
        {.name = "shared_sobol_constant", .keys = pattern("constant") + by("shared-sobol", 1, 15)},
        {.name = "exact_inverse_zoneplate", .keys = pattern("zoneplate") + by("stratified", 2, 40)},
        {.name = "stratified_wheel",
         .keys = pattern("wheel") + by("stratified", 3, 4) + kShutter + Keys{"sampling.time_order=4"}},
        {.name = "shared_sobol_wheel_passes",
         .keys = pattern("wheel") + by("shared-sobol", 2, 1) + kShutter,
         .passes = 2},
    };
}

// The Earth's air: the sun and sky that it makes, the mountains that are not there, and how it hides what is far.
std::vector<GoldenScene> daylights() {
    const Keys daylight = kTerrain + Keys{"sky.model=daylight", "scale.metres=300", "sky.visibility_km=40"};
    return {
        {.name = "daylight", .keys = daylight + kStratified},
        {.name = "daylight_shadow_from_afar",
         .keys = daylight +
                 Keys{"sun.direction=[-0.8,0.05,0.35]", "sun.shadow_height=0.2", "sun.shadow_relief=0.6",
                      "sky.gain=1.5", "surface.drift=[3,0,2]"} +
                 kShutter},
        {.name = "daylight_layers", .keys = daylight + Keys{"sampling.m=3"}, .channels = kLight},
        {.name = "daylight_fog",
         .keys = daylight + kStratified +
                 Keys{"fog.visibility_m=3000", "fog.level_m=20", "fog.fall_m=60", "fog.rise_m=30", "fog.patch_m=900"}},
        {.name = "daylight_clouds",
         .keys = daylight + kStratified,
         .channels = {"cloud", "sun", "air", "background"},
         .relief = kTwoClouds},
        {.name = "clouds_from_above",
         .keys = daylight + kShutter + camera_keys("[0,6,0]", "[0,2,1]") +
                 Keys{"sky.light=rays", "camera.look_at=[0,0,7]", "fog.visibility_m=3000", "fog.fall_m=60"},
         .relief = kTwoClouds},
        {.name = "fog_shafts",
         .keys = kTerrain + Keys{"scale.metres=300", "fog.visibility_m=3000", "fog.level_m=100", "fog.fall_m=60",
                                 "fog.rise_m=30", "fog.patch_m=900", "fog.shafts=true"},
         .channels = {"air", "steps", "evals"}},
        {.name = "daylight_shafts",
         .keys = daylight + kStratified +
                 Keys{"fog.visibility_m=3000", "fog.level_m=100", "fog.fall_m=60", "fog.shafts=true",
                      "sun.angular_radius_deg=1", "water.present=true", "water.level_m=90"},
         .relief = kTwoClouds},
        {.name = "even_fog", .keys = kTerrain + Keys{"scale.metres=300", "fog.visibility_m=5000", "fog.forward=0"}},
        {.name = "daylight_no_shadows",
         .keys = daylight + kNoShadows + Keys{"surface.kind=hyperterrain", "surface.rotation_deg=[10,40,-15]"}},
    };
}

// Light that draws from dimensions of its own: a sun with a disc, sky rays, reflections.
std::vector<GoldenScene> soft_lights() {
    const Keys soft{"sun.angular_radius_deg=3"}, rays{"sky.light=rays"};
    const Keys low{"surface.octaves=4", "sampling.N=1"};
    return {
        {.name = "soft_sun", .keys = kTerrain + soft},
        {.name = "soft_sun_daylight",
         .keys = kTerrain + soft + Keys{"sky.model=daylight", "scale.metres=300"} + kStratified},
        {.name = "sky_rays", .keys = kTerrain + rays + kStratified, .channels = kCosts},
        {.name = "sky_rays_daylight",
         .keys = kTerrain + soft + rays + Keys{"sky.model=daylight", "scale.metres=300", "sky.gain=1.5"},
         .crop = film::Rect{8, 9, 24, 17}},
        {.name = "sky_rays_spin_bounces",
         .keys = kPlanet + soft + rays + kShutter +
                 Keys{"sky.bounces=3", "surface.spin_deg_per_s=72", "surface.octaves=5"}},
        {.name = "sky_rays_layers",
         .keys = kTerrain + soft + rays + kStratified,
         .crop = film::Rect{8, 9, 24, 17},
         .channels = {"sun", "sky", "bounce", "air", "background"}},
        {.name = "sky_rays_isosurface", .keys = kIsosurface + rays + low},
        {.name = "sky_rays_reference", .keys = kTerrain + soft + rays + low, .tracer = integrate::Tracer::reference},
    };
}

// Level water: like glass with its bed near, with waves under daylight and by sky rays, and as a layer of light.
std::vector<GoldenScene> waters() {
    const Keys water{"water.present=true", "water.level_m=0.3"};
    const Keys shallow = kTerrain + water + Keys{"water.wind_m_s=0", "water.absorption=[0.9,0.3,0.2]"};
    const Keys waves{"water.level_m=90", "water.wind_m_s=4", "water.waves_m=50", "sky.model=daylight",
                     "scale.metres=300"};
    return {
        {.name = "water", .keys = shallow + kStratified, .channels = kCosts},
        {.name = "water_waves", .keys = kTerrain + water + waves},
        {.name = "water_sky_rays",
         .keys = shallow + Keys{"sky.light=rays", "water.wind_m_s=1", "sun.angular_radius_deg=0.27"},
         .crop = film::Rect{8, 9, 24, 17}},
        {.name = "water_layers",
         .keys = kTerrain + water + waves + kStratified,
         .channels = {"sun", "sky", "water", "air", "background", "P", "N"}},
    };
}

// Composed reliefs: every type of term, over the plane and in space.
std::vector<GoldenScene> reliefs() {
    const Keys above{"camera.position=[0,2.5,0]", "sampling.N=1"};
    return {
        {.name = "relief_shapes_in_space",
         .keys = kHyperterrain + Keys{"camera.position=[0.3,2.5,0.1]", "sampling.N=1"},
         .crop = film::Rect{12, 8, 22, 13},
         .relief = kShapes},
        {.name = "relief_places", .keys = kTerrain + above, .crop = film::Rect{12, 8, 22, 13}, .relief = kPlaces},
        {.name = "relief_ridged_warp", .keys = kTerrain + above, .relief = kCrests},
        {.name = "relief_landform", .keys = kTerrain + above, .crop = film::Rect{12, 8, 22, 13}, .relief = kLandform},
        {.name = "relief_in_space",
         .keys = kHyperterrain + Keys{"camera.position=[0.3,2.5,0.1]", "sampling.N=1"},
         .relief = kCrests},
    };
}

// Layers of ground: every kind of mask, rough and smooth, over a height field, a planet and ground that drifts.
std::vector<GoldenScene> layers() {
    return {
        {.name = "ground", .keys = kTerrain, .relief = kGround},
        {.name = "ground_rough_drift",
         .keys = kTerrain + kShutter + kStratified + Keys{"ground.rock.roughness=0.7", "surface.drift=[3,0,2]"},
         .relief = kGround},
        {.name = "ground_mattes", .keys = kTerrain, .channels = {"mask", "cryptomatte"}, .relief = kGround},
        {.name = "ground_mattes_stratified",
         .keys = kTerrain + kStratified,
         .channels = {"cryptomatte", "albedo", "mask"},
         .relief = kGround},
        {.name = "ground_planet",
         .keys = kPlanet + Keys{"ground.snow.height_from=0.02", "ground.beds.roughness=0.3", "sampling.N=1"},
         .relief = kGround},
    };
}

}  // namespace

std::vector<GoldenScene> golden_scenes() {
    std::vector<GoldenScene> all;
    for (auto* group : {grounds, bodies, extremes, estimators, daylights, soft_lights, waters, reliefs, layers}) {
        for (GoldenScene& golden : group()) all.push_back(std::move(golden));
    }
    return all;
}

scene::Scene scene_of(const GoldenScene& golden) {
    scene::Scene scene;
    if (!golden.relief.empty()) scene = scene::read_scene(golden.relief, golden.name);
    for (const std::string& key : golden.keys) scene::apply_override(scene, key);
    scene::validate(scene, golden.name);
    return scene;
}

}  // namespace strata::golden
