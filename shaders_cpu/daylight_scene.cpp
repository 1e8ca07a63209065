#include "shaders_cpu/daylight_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "noise/reference.h"

namespace strata::shaders {

namespace {

constexpr double kHighest = 100e3, kLowest = -1000.0;  // of the model, metres

Atmosphere atmosphere_of(const scene::Sky& sky) {
    Atmosphere atmosphere;
    atmosphere.visibility = 1000.0 * sky.visibility_km;
    return atmosphere;
}

// Three octaves, the coarsest as long as ten times the ridges are high; amplitude 1 in all.
std::vector<noise::Octave> ridge_octaves(const scene::Sun& sun) {
    if (sun.shadow_relief <= 0.0) return {};
    return noise::make_octaves({.octaves = 3,
                                .lacunarity = 3.7,
                                .gain = 0.4,
                                .amplitude = sun.shadow_relief,
                                .frequency = 0.1 / sun.shadow_relief,
                                .seed = 1});
}

glm::vec3 radiance_of(const glm::dvec3& luminance) { return glm::vec3(luminance / kLuminanceOfOne); }

}  // namespace

DaylightScene::DaylightScene(const scene::Scene& scene, const glm::dvec3& to_sun, const glm::dvec3& eye)
    : metres_(scene.scale.metres),
      altitude_(scene.sky.altitude_m),
      gain_(scene.sky.gain),
      sun_(scene.sun),
      across_(to_sun.z, 0.0, -to_sun.x),
      ridges_(ridge_octaves(scene.sun)),
      daylight_(atmosphere_of(scene.sky), to_sun, std::clamp(altitude_ + eye.y * metres_, kLowest, kHighest)) {}

glm::vec3 DaylightScene::sky(const glm::dvec3& direction) const {
    return radiance_of(daylight_.sky_radiance(direction));
}

glm::vec3 DaylightScene::sun_on_white(double height) const {
    const double metres = std::clamp(altitude_ + height * metres_, kLowest, kHighest);
    return radiance_of(daylight_.sun_illuminance(metres) * std::numbers::inv_pi);
}

float DaylightScene::sun_over_ridges(const glm::dvec3& x) const {
    double ridge = sun_.shadow_height;
    const double across = glm::dot(x, across_);
    for (const noise::Octave& octave : ridges_) {
        const noise::Point<2> p{octave.frequency * across + octave.offset[0], octave.offset[1]};
        ridge += octave.amplitude * noise::reference_value<2>(octave.key, noise::split_position<2>(p));
    }
    const double t = std::clamp((x.y - ridge) / sun_.shadow_width + 0.5, 0.0, 1.0);
    return static_cast<float>(t * t * (3.0 - 2.0 * t));
}

glm::vec3 DaylightScene::sky_on_white(const glm::dvec3& normal) const {
    const glm::dvec3 light = daylight_.sky_irradiance(normal) + daylight_.ground_irradiance(normal);
    return radiance_of(light * (gain_ * std::numbers::inv_pi));
}

MediumSegment DaylightScene::air_along(const glm::dvec3& direction, double distance) const {
    const AerialPerspective air = daylight_.aerial_from_observer(direction, distance * metres_);
    return {.transmittance = glm::vec3(air.transmittance), .inscatter = radiance_of(air.inscatter)};
}

}  // namespace strata::shaders
