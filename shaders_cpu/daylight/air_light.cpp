#include "shaders_cpu/daylight/air_light.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace strata::shaders {

AirLight::AirLight(const Atmosphere& atmosphere, int scattered_orders, ScatteredLight::Rest rest)
    : medium_(atmosphere), sun_(medium_), scattered_(medium_, sun_, scattered_orders, rest) {}

AirRadiance AirLight::of_step(const AirPath& path, const AirStep& step, double sun_up, double cosine) const {
    constexpr double kEven = 1.0 / (4.0 * std::numbers::pi);
    const double up = (path.start_radius() * sun_up + step.distance * cosine) / step.radius;
    const Sunlight sun = sun_.at(step.sun_cell, step.horizon, up);
    const Bands scattered = scattered_.mean_radiance(step.diffuse_cell, up);
    return {step.air * (sun.diffuse * AirModel::rayleigh_phase(cosine) + scattered) +
                step.even_haze * (sun.diffuse * kEven + scattered),
            step.haze * sun.full};
}

AirRadiance AirLight::of_path(const AirPath& path, double sun_up, double cosine) const {
    AirRadiance sum;
    for (const AirStep& step : path.steps()) sum += of_step(path, step, sun_up, cosine);
    return sum;
}

Bands AirLight::of_ground(const AirPath& path, double sun_up, double cosine) const {
    const double up = (path.start_radius() * sun_up + path.length() * cosine) / kEarthRadius;
    const Bands irradiance = sun_.at({0, 0.0f}, 0.0, up).diffuse * std::max(0.0, up) + scattered_.ground_irradiance(up);
    return path.diffuse_transmittance() * irradiance * (medium_.ground_albedo() / std::numbers::pi);
}

AirRadiance AirLight::of_sky(double height, double up, double sun_up, double cosine) const {
    const double ground = distance_to_ground(height, up);
    const AirPath path(medium_, height, up, ground, kPathSteps);
    AirRadiance light = of_path(path, sun_up, cosine);
    if (ground < std::numeric_limits<double>::infinity()) light.even += of_ground(path, sun_up, cosine);
    return light;
}

}  // namespace strata::shaders
