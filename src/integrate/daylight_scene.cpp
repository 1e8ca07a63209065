#include "src/integrate/daylight_scene.h"

#include <algorithm>
#include <numbers>

namespace strata::integrate {

namespace {

constexpr double kHighest = 100e3, kLowest = -1000.0;  // of the model, metres

shaders::Atmosphere atmosphere_of(const scene::Sky& sky) {
    shaders::Atmosphere atmosphere;
    atmosphere.visibility = 1000.0 * sky.visibility_km;
    return atmosphere;
}

glm::vec3 radiance_of(const glm::dvec3& luminance) { return glm::vec3(luminance / kLuminanceOfOne); }

}  // namespace

DaylightScene::DaylightScene(const scene::Scene& scene, const glm::dvec3& to_sun, const glm::dvec3& eye)
    : metres_(scene.scale.metres),
      altitude_(scene.sky.altitude_m),
      gain_(scene.sky.gain),
      daylight_(atmosphere_of(scene.sky), to_sun, std::clamp(altitude_ + eye.y * metres_, kLowest, kHighest)) {}

glm::vec3 DaylightScene::sky(const glm::dvec3& direction) const {
    return radiance_of(daylight_.sky_radiance(direction));
}

glm::vec3 DaylightScene::sun_on_white(double height) const {
    const double metres = std::clamp(altitude_ + height * metres_, kLowest, kHighest);
    return radiance_of(daylight_.sun_illuminance(metres) * std::numbers::inv_pi);
}

glm::vec3 DaylightScene::sky_on_white(const glm::dvec3& normal) const {
    const glm::dvec3 light = daylight_.sky_irradiance(normal) + daylight_.ground_irradiance(normal);
    return radiance_of(light * (gain_ * std::numbers::inv_pi));
}

glm::vec3 DaylightScene::through_air(const glm::vec3& radiance, const glm::dvec3& direction, double distance) const {
    const shaders::AerialPerspective air = daylight_.aerial_from_observer(direction, distance * metres_);
    return radiance * glm::vec3(air.transmittance) + radiance_of(air.inscatter);
}

}  // namespace strata::integrate
