#include "shaders_cpu/terrain_material.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders_cpu/sky.h"

namespace strata::shaders {
namespace {

// Half the difference between the light from the sunward and from the opposite half of the sky, over their mean;
// chosen. It gives shape to what lies in shadow.
constexpr double kSunwardSky = 0.35;

// 0 to 1 over [centre - width/2, centre + width/2], width > 0.
double blend(double x, double centre, double width) {
    const double s = std::clamp((x - centre) / width + 0.5, 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s);
}

// Arc cosine of x in [-1, 1], degrees, to 0.004 degrees: Abramowitz and Stegun 4.4.45. Near 1 that of a float cosine is
// in doubt by five times as much.
double arc_cosine_deg(double x) {
    const double size = std::abs(x);
    const double series = ((-0.0187293 * size + 0.0742610) * size - 0.2121144) * size + 1.5707288;
    const double angle = std::sqrt(1.0 - size) * series * (180.0 / std::numbers::pi);
    return x < 0.0 ? 180.0 - angle : angle;
}

}  // namespace

glm::vec3 albedo(const scene::Material& material, double height, double slope_cosine) {
    const double slope_deg = arc_cosine_deg(std::clamp(slope_cosine, -1.0, 1.0));
    const double high = blend(height, material.band_height, material.band_width);
    const double steep = blend(slope_deg, material.steep_deg, material.steep_width_deg);
    const glm::dvec3 gentle = material.low * (1.0 - high) + material.high * high;
    return glm::vec3(gentle * (1.0 - steep) + material.steep * steep);
}

glm::vec3 shade(const scene::Material& material, const scene::Sun& sun, const scene::Sky& sky,
                const SurfacePoint& point) {
    const double n_dot_sun = std::clamp(point.n_dot_sun, -1.0, 1.0);
    const double facing = std::max(n_dot_sun, 0.0) * point.sun_visibility;
    const glm::vec3 sunlight(sun.colour * (sun.intensity * facing / std::numbers::pi));
    const double sunward = sun.intensity > 0.0 ? 1.0 + kSunwardSky * n_dot_sun : 1.0;
    const glm::vec3 skylight = ambient_light(sky, point.up_dot_normal) * static_cast<float>(sunward);
    return albedo(material, point.height, point.up_dot_normal) * (sunlight + skylight);
}

}  // namespace strata::shaders
