#include "src/scene/keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <tuple>
#include <type_traits>
#include <utility>

#include "src/scene/cloud_keys.h"
#include "src/scene/enum_names.h"
#include "src/scene/ground_keys.h"
#include "src/scene/key_list.h"
#include "src/scene/key_makers.h"
#include "src/scene/pattern_keys.h"
#include "src/scene/relief_keys.h"
#include "src/scene/water_keys.h"

namespace strata::scene {

namespace key_makers {
namespace {

constexpr Range kFieldOfView{0.01, 179.0};
constexpr Range kDrift{-1e6, 1e6};
constexpr Range kTime{-1e9, 1e9};

Section top_section(Scene& s) {
    return section("", "", true,
                   {plain("title", s.title, "one line for listings"),
                    choice("image", s.image, "what is pictured: a ray-cast surface or a test pattern")});
}

Section film_section(Film& film) {
    return section("film", "the frame", true,
                   {count("width", film.width, {1, 65536}, "pixels", "width of the whole frame"),
                    count("height", film.height, {1, 65536}, "pixels", "height of the whole frame"),
                    number("exposure", film.exposure, {-64.0, 64.0}, "stops",
                           "brightening of 8- and 16-bit pictures; EXR stays linear"),
                    plain("metered", film.metered,
                          "whether exposure counts from a light meter's: the whole frame's mean is mid grey"),
                    choice("tone", film.tone,
                           "tone curve of 8- and 16-bit pictures: none clips at 1, reinhard keeps hues, agx whitens "
                           "what is bright as film does; mid grey stays"),
                    colour("white_balance", film.white_balance, kWhiteBalance,
                           "factors of 8- and 16-bit pictures, beside exposure"),
                    number("saturation", film.saturation, kSaturation, "",
                           "of 8- and 16-bit pictures, about luminance; behind agx's curve, before the others"),
                    only_if(film.tone == ToneCurve::agx,
                            number("contrast", film.contrast, kContrast, "", "agx: of the curve at mid grey"))});
}

Section sampling_section(Sampling& sampling, bool surface) {
    return section(
        "sampling", "how samples become pixels", true,
        {choice("estimator", sampling.estimator,
                "none is one sample at the centre, stratified the paper's (3), shared-sobol has the least error for "
                "its time"),
         count("N", sampling.N, {1, 64}, "", "samples a side: N * N a pixel"),
         count("m", sampling.m, {1, 100}, "", "order of the B-spline filter in space; 1 is the box, 4 the cubic"),
         count("time_order", sampling.time_order, {1, 100}, "",
               "order of the B-spline filter in time; support time_order * open_s"),
         plain("seed", sampling.seed, "chooses the sample positions"),
         only_if(surface, number("tolerance", sampling.tolerance, {1e-12, 1.0}, "pixel widths at the hit's distance",
                                 "how far a reported hit may be from the surface along the ray"))});
}

Section shutter_section(Shutter& shutter) {
    // Frame times stay finite because fps is bounded below and frame above.
    return section("shutter", "frame k begins at k / fps seconds", true,
                   {key("fps", &shutter.fps, {1e-3, 1e6}, "frames/s", "frame rate; a fraction as text, \"24000/1001\""),
                    number("open_s", shutter.open_s, {0.0, 1e6}, "s", "time the shutter is open; 0: an instant"),
                    count("frame", shutter.frame, {0, 1e9}, "", "number of the frame, from 0")});
}

Section camera_section(Camera& camera, bool matters) {
    return section(
        "camera", "the eye; right-handed, y up", matters,
        {vector("position", camera.position, kAnywhere, "world units", "where the eye is"),
         vector("look_at", camera.look_at, kAnywhere, "world units", "the point in the middle of the frame"),
         direction("up", camera.up, "what is up in the picture; another is picked when the view runs along it"),
         number("fov_deg", camera.fov_deg, kFieldOfView, "degrees", "horizontal field of view"),
         number("far", camera.far, kDistance, "world units along a ray", "nothing is seen beyond"),
         choice("interpolation", camera.interpolation,
                "between keys: smooth eases through them without overshoot, linear goes straight"),
         plain("keys", camera.keys,
               "the camera over time, also as [[camera.keys]]; it rests before the first and after the last; parts "
               "left out are the camera's own")});
}

std::string_view kinds_meaning() {
    static const std::string all = [] {
        std::vector<std::string_view> each;
        for (const solid::KindRow& row : solid::all_solids()) each.push_back(row.meaning);
        return fmt::format("{}", fmt::join(each, ", "));
    }();
    return all;
}

// Of all kinds of solids. Those of others than the chosen one do not matter.
std::vector<Key> solid_keys(Surface& surface) {
    std::vector<Key> all;
    const auto take = [&](auto& shape) {
        KeyList list;
        shape.keys(list);
        for (Key& key : list.take()) {
            all.push_back(only_if(surface.kind == solid::kKind<std::remove_cvref_t<decltype(shape)>>, std::move(key)));
        }
    };
    std::apply([&](auto&... shapes) { (take(shapes), ...); }, surface.shapes);
    return all;
}

Section surface_section(Surface& surface, bool matters) {
    const bool own_sum = surface.relief.empty();
    std::vector<Key> keys{
        choice("kind", surface.kind, kinds_meaning()),
        vector("origin", surface.origin, kAnywhere, "world units", "where the surface's own origin is"),
        vector("rotation_deg", surface.rotation_deg, kAngle, "degrees", "turn about x, then y, then z"),
        number("scale", surface.scale, kLength, "world units", "length of one surface unit"),
        direction("spin_axis", surface.spin_axis,
                  "axis of the spin through the origin, in world directions; spun after rotation_deg"),
        number("spin_deg_per_s", surface.spin_deg_per_s, kAngle, "degrees/s", "speed of the spin; 0: at rest"),
        vector("drift", surface.drift, kDrift, "surface units/s",
               "how the noise moves through the surface, in its own directions: terrain flows, bodies morph"),
        only_if(own_sum, count("octaves", surface.octaves, {1, 32}, "", "terms of the sum")),
        only_if(own_sum,
                number("lacunarity", surface.lacunarity, {1.0, 10.0}, "", "frequency ratio of neighbouring octaves")),
        only_if(own_sum, number("gain", surface.gain, {0.0, 1.0}, "", "amplitude ratio of neighbouring octaves")),
        only_if(own_sum, number("amplitude", surface.amplitude, {0.0, 1e6}, "surface units", "amplitude of octave 0")),
        only_if(own_sum, number("frequency", surface.frequency, {1e-9, 1e9}, "lattice cells a surface unit",
                                "frequency of octave 0")),
        only_if(own_sum, plain("seed", surface.seed, "chooses the noise"))};
    for (Key& key : solid_keys(surface)) keys.push_back(std::move(key));
    return section("surface", "sum over octaves k of amplitude * gain^k * noise(frequency * lacunarity^k * x)", matters,
                   std::move(keys));
}

Section scale_section(Scale& scale, bool matters) {
    return section(
        "scale", "how large the scene is", matters,
        {number("metres", scale.metres, kLength, "m", "metres in a surface unit, for what is told in metres")});
}

Section sun_section(Sun& sun, bool daylight, bool matters) {
    return section(
        "sun", "light from infinitely far", matters,
        {direction("direction", sun.direction, "towards the sun"),
         only_if(!daylight, colour("colour", sun.colour, kLight, "colour of its light")),
         only_if(!daylight, number("intensity", sun.intensity, kLight, "", "times colour is the light; 0: no sun")),
         plain("shadows", sun.shadows, "whether the surface shadows itself"),
         number("angular_radius_deg", sun.angular_radius_deg, {0.0, 45.0}, "degrees",
                "of its disc, which softens shadows; 0: a point. The Earth's sun has 0.2666"),
         only_if(daylight, number("shadow_height", sun.shadow_height, {-1e6, 1e6}, "surface units",
                                  "daylight: up to here lies the shadow of mountains out of the picture")),
         only_if(daylight, number("shadow_relief", sun.shadow_relief, {0.0, 1e6}, "surface units",
                                  "daylight: how far their ridge line makes its edge go up and down")),
         only_if(daylight, number("shadow_width", sun.shadow_width, {1e-9, 1e6}, "surface units",
                                  "daylight: height over which that shadow ends"))});
}

Section sky_section(Sky& sky, bool matters) {
    const bool daylight = sky.model == SkyModel::daylight;
    return section(
        "sky", "what rays that miss see", matters,
        {choice("model", sky.model,
                "gradient: two chosen colours; daylight: the Earth's air, which makes the sun's colour and the blue "
                "of distance too, 1 being 25 000 cd/m2"),
         only_if(!daylight, colour("zenith", sky.zenith, kLight, "colour straight up")),
         only_if(!daylight, colour("horizon", sky.horizon, kLight, "colour at the horizon, and of the haze")),
         only_if(!daylight, number("haze_distance", sky.haze_distance, {0.0, 1e12}, "surface units",
                                   "distance over which 1 - 1/e of the light becomes horizon; 0: no haze")),
         choice("light", sky.light,
                "on the ground - open: as if all of the sky were seen, by a formula; rays: a ray a sample, which finds "
                "what hides it and the light that other ground reflects"),
         only_if(sky.light == SkyLight::rays,
                 count("bounces", sky.bounces, {0, 16}, "",
                       "rays: how often ground may reflect light on its way to what is seen; each may cost two rays")),
         only_if(daylight, number("visibility_km", sky.visibility_km, {1.0, 250.0}, "km",
                                  "daylight: distance at sea level at which 2 % of the contrast is left")),
         only_if(daylight, number("altitude_m", sky.altitude_m, {-500.0, 50'000.0}, "m",
                                  "daylight: of the surface's y = 0 over the sea")),
         only_if(daylight, number("gain", sky.gain, {0.0, 100.0}, "",
                                  "daylight: of the sky's light on the ground; 1 is true, more fills shadows"))});
}

Section fog_section(Fog& fog, bool matters) {
    const bool is_foggy = fog.visibility_m > 0.0;
    return section(
        "fog", "fog that lies low: thins upwards, exp(-(y - level_m) / fall_m)", matters,
        {number("visibility_m", fog.visibility_m, {0.0, 1e7}, "m",
                "at its level, distance at which 2 % of the contrast is left; 0: no fog"),
         only_if(is_foggy, number("level_m", fog.level_m, {-1e5, 1e5}, "m", "its height over the surface's y = 0")),
         only_if(is_foggy, number("fall_m", fog.fall_m, {0.01, 1e5}, "m", "height over which it thins to 1/e")),
         only_if(is_foggy,
                 number("rise_m", fog.rise_m, {0.0, 1e5}, "m", "how far a noise lifts and lowers it; 0: it lies even")),
         only_if(is_foggy, number("patch_m", fog.patch_m, {0.1, 1e7}, "m", "length of that noise's largest waves")),
         only_if(is_foggy, number("forward", fog.forward, {-0.95, 0.95}, "",
                                  "mean cosine of its scattering: 0 even, near 1 a bright glow about the sun")),
         only_if(is_foggy, plain("shafts", fog.shafts,
                                 "whether ground and clouds throw their shadows into it: a shadow ray a sample"))});
}

Section material_section(Material& material, bool matters) {
    return section(
        "material", "diffuse reflectance by height and slope", matters,
        {colour("low", material.low, kReflectance, "colour below band_height, on gentle slopes"),
         colour("high", material.high, kReflectance, "colour above band_height, on gentle slopes"),
         colour("steep", material.steep, kReflectance, "colour on slopes above steep_deg"),
         number("band_height", material.band_height, {-1e9, 1e9}, "surface units",
                "where low becomes high, over the base plane or sphere"),
         number("band_width", material.band_width, kLength, "surface units", "height over which low becomes high"),
         number("steep_deg", material.steep_deg, {0.0, 90.0}, "degrees", "slope where steep begins"),
         number("steep_width_deg", material.steep_width_deg, {1e-3, 90.0}, "degrees",
                "slopes over which steep takes over")});
}

}  // namespace
}  // namespace key_makers

Section describe_camera_key(CameraKey& entry, Camera& rest, std::size_t index) {
    using namespace key_makers;
    return section(
        fmt::format("camera.keys[{}]", index), "the camera at one time", true,
        {number("time_s", entry.time_s, kTime, "s", "when"),
         vector("position", entry.position ? *entry.position : rest.position, kAnywhere, "world units", "where it is"),
         vector("look_at", entry.look_at ? *entry.look_at : rest.look_at, kAnywhere, "world units", "what it looks at"),
         number("fov_deg", entry.fov_deg ? *entry.fov_deg : rest.fov_deg, kFieldOfView, "degrees",
                "horizontal field of view")});
}

namespace {

bool is_in_metres(const Scene& scene) {
    return scene.sky.model == SkyModel::daylight || scene.fog.visibility_m > 0.0 || scene.water.present;
}

}  // namespace

std::vector<Section> describe(Scene& scene) {
    using namespace key_makers;
    const bool surface = scene.image == ImageKind::surface;
    std::vector<Section> all{top_section(scene),
                             film_section(scene.film),
                             sampling_section(scene.sampling, surface),
                             shutter_section(scene.shutter),
                             camera_section(scene.camera, surface),
                             surface_section(scene.surface, surface),
                             scale_section(scene.scale, surface && is_in_metres(scene)),
                             sun_section(scene.sun, scene.sky.model == SkyModel::daylight, surface),
                             sky_section(scene.sky, surface),
                             fog_section(scene.fog, surface),
                             describe_water(scene.water, surface),
                             material_section(scene.material, surface && scene.ground.empty())};
    add_pattern_sections(scene, all);
    for (noise::ReliefTerm& term : scene.surface.relief) {
        all.push_back(describe_relief_term(term));
        for (Key& key : all.back().keys) key.matters = surface;
    }
    for (GroundLayer& layer : scene.ground) {
        all.push_back(describe_ground_layer(layer));
        for (Key& key : all.back().keys) key.matters = surface;
    }
    for (CloudLayer& layer : scene.clouds) {
        all.push_back(describe_cloud_layer(layer));
        for (Key& key : all.back().keys) key.matters = surface;
    }
    return all;
}

}  // namespace strata::scene
