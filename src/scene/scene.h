// What a picture is made of: plain values with their defaults. keys.h documents every one (unit, range, meaning).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "noise/relief/relief.h"
#include "src/scene/clouds.h"
#include "src/scene/estimators.h"
#include "src/scene/ground.h"
#include "src/scene/rate.h"
#include "src/solid/solid.h"

namespace strata::scene {

enum class ImageKind { surface, zoneplate, checker, wheel, edge, ramp, constant };
enum class ToneCurve { none, reinhard, agx };
enum class Interpolation { smooth, linear };
enum class SkyModel { gradient, daylight };
enum class SkyLight { open, rays };

struct Film {
    int width = 1280;
    int height = 720;

    // Of 8- and 16-bit pictures only; EXR stays linear.
    double exposure = 0.0;  // stops
    bool metered =
        false;  // exposure counts from what render::take_exposure finds, which writes the sum and resets this
    ToneCurve tone = ToneCurve::none;
    glm::dvec3 white_balance{1.0};  // factors, beside exposure
    double saturation = 1.0;        // about luminance
    double contrast = 1.0;          // agx: of its sigmoid at mid grey

    // The same frame with light as it is: for what colour has no part in.
    Film without_colour() const {
        Film film;
        film.width = width;
        film.height = height;
        return film;
    }
};

struct Sampling {
    EstimatorKind estimator = EstimatorKind::shared_sobol;
    int N = 4;           // samples a side: N*N a pixel
    int m = 4;           // order of the B-spline in space
    int time_order = 1;  // order l of the B-spline in time
    std::uint64_t seed = 1;
    double tolerance = 0.1;  // of a ray's hit, in pixel widths at that distance

    int samples_a_side() const { return row_of(estimator).is_single ? 1 : N; }
    int samples_a_pixel() const { return samples_a_side() * samples_a_side(); }
};

struct Shutter {
    Rate fps = 25.0;
    double open_s = 0.0;  // 0: an instant, no time samples
    int frame = 0;

    // When the frame begins.
    double time_s() const { return fps.seconds(frame); }
};

// Where the camera is at one time; what is left out is the camera's own.
struct CameraKey {
    double time_s = 0.0;
    std::optional<glm::dvec3> position{}, look_at{};
    std::optional<double> fov_deg{};
};

struct Camera {
    glm::dvec3 position{0.0, 1.0, 0.0};
    glm::dvec3 look_at{0.0, 1.0, 1.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    double fov_deg = 50.0;  // horizontal
    double far = 1000.0;    // world units along a ray
    Interpolation interpolation = Interpolation::smooth;
    std::vector<CameraKey> keys{};  // by time; none: a still camera. camera_path.h goes through them
};

// Sum over octaves k of amplitude * gain^k * n(frequency * lacunarity^k * (x - drift t) + offset_k).
struct Surface {
    solid::Kind kind = solid::kKind<solid::HeightField>;
    solid::Solids shapes{};  // of each kind, its own keys
    glm::dvec3 origin{0.0};
    glm::dvec3 rotation_deg{0.0};  // about x, then y, then z
    double scale = 1.0;
    glm::dvec3 spin_axis{0.0, 1.0, 0.0};  // through origin, in world directions; after rotation_deg
    double spin_deg_per_s = 0.0;
    glm::dvec3 drift{0.0};  // of the noise, in surface units a second and the surface's own directions
    int octaves = 8;
    double lacunarity = 2.0;
    double gain = 0.5;
    double amplitude = 0.6;
    double frequency = 0.5;
    std::uint64_t seed = 1;

    // Where there are terms, the last of them stands for the sum over octaves. In scene files: [[relief]].
    std::vector<noise::ReliefTerm> relief{};

    // What is in front of the relief: the shape of the chosen kind.
    solid::Solid solid() const { return solid::pick(shapes, kind); }

    // The keys of one kind, whether it is the chosen one or not.
    template <class S>
    S& shape() {
        return std::get<S>(shapes);
    }
    template <class S>
    const S& shape() const {
        return std::get<S>(shapes);
    }
};

// How large the scene is, for what is told in metres.
struct Scale {
    double metres = 1.0;  // in a surface unit
};

struct Sun {
    glm::dvec3 direction{0.4, 0.5, -0.3};  // towards the sun, any length
    glm::dvec3 colour{1.0, 0.93, 0.82};
    double intensity = 2.6;
    bool shadows = true;
    double angular_radius_deg = 0.0;  // of its disc; 0: a point, and shadows are hard

    // daylight: the shadow of mountains that the scene does not have, up to about this height
    double shadow_height = -1e6;  // surface units; far below: none
    double shadow_relief = 0.0;   // how much its edge goes up and down, surface units
    double shadow_width = 0.05;   // how soft its edge is, surface units
};

struct Sky {
    SkyModel model = SkyModel::gradient;
    glm::dvec3 zenith{0.13, 0.28, 0.62};
    glm::dvec3 horizon{0.62, 0.74, 0.88};
    double haze_distance = 0.0;  // surface units over which 1 - 1/e of the light becomes horizon; 0: no haze
    SkyLight light = SkyLight::open;
    int bounces = 1;  // rays: how often ground may reflect light before it reaches what is seen

    // daylight
    double visibility_km = 80.0;  // at sea level, where 2 % of the contrast is left
    double altitude_m = 500.0;    // of the surface's y = 0 over the sea
    double gain = 1.0;            // of the sky's light on the ground; 1 is true, more is a photographer's fill
};

// Low-lying fog (shaders_cpu/media/fog.h), in metres.
struct Fog {
    double visibility_m = 0.0;  // at its level, where 2 % of the contrast is left; 0: no fog
    double level_m = 0.0;       // over y = 0
    double fall_m = 50.0;       // height over which it thins to 1/e
    double rise_m = 0.0;        // how far a noise lifts and lowers it
    double patch_m = 4000.0;    // length of that noise's largest waves
    double forward = 0.6;       // mean cosine of scattering
    bool shafts = false;        // whether what hides the sun throws its shadow into it
};

// Level water (shaders_cpu/water.h), in metres.
struct Water {
    bool present = false;
    double level_m = 0.0;                     // over y = 0
    double wind_m_s = 3.0;                    // which raises its waves
    double waves_m = 8.0;                     // length of the largest of them
    glm::dvec3 absorption{0.34, 0.06, 0.03};  // of what is left along a way, a metre
    glm::dvec3 deep{0.0, 0.006, 0.008};       // reflectance of water without a bed
};

struct Material {
    glm::dvec3 low{0.16, 0.20, 0.07};    // meadow: below band_height, gentle slopes
    glm::dvec3 high{0.86, 0.88, 0.92};   // snow: above band_height, gentle slopes
    glm::dvec3 steep{0.30, 0.26, 0.22};  // rock: slopes above steep_deg
    double band_height = 0.25;           // height above the base plane or sphere, in surface units
    double band_width = 0.1;
    double steep_deg = 38.0;
    double steep_width_deg = 12.0;
};

struct Zoneplate {
    double rings = 0.0;  // periods from the centre to the nearer edge; 0: the last is 2 px wide
};

struct Checker {
    double square = 1.0;   // world units
    double height = 1.0;   // of the eye over the plane
    double horizon = 0.3;  // fraction of the frame's height, from the top
};

struct Wheel {
    int spokes = 12;
    double turns_per_s = 0.5;  // counter-clockwise on the screen
    double spoke_fill = 0.4;   // fraction of the angle that is spoke
};

struct Edge {
    double angle_deg = 30.0;  // of the white side's direction, counter-clockwise from right
    double offset = 0.0;      // px from the frame's centre
};

struct Ramp {
    double angle_deg = 30.0;  // of the rise, counter-clockwise from right
    double rise = 1.0;        // over the frame's width
};

struct Constant {
    double value = 0.5;  // linear radiance
};

struct Scene {
    std::string title;
    ImageKind image = ImageKind::surface;
    Film film;
    Sampling sampling;
    Shutter shutter;
    Camera camera;
    Surface surface;
    Scale scale;
    Sun sun;
    Sky sky;
    Fog fog;
    std::vector<CloudLayer> clouds{};  // in scene files: [[clouds]]
    Water water;
    Material material;
    std::vector<GroundLayer> ground{};  // lowest first; none: material alone. In scene files: [[ground]]
    Zoneplate zoneplate;
    Checker checker;
    Wheel wheel;
    Edge edge;
    Ramp ramp;
    Constant constant;
};

}  // namespace strata::scene
