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
float blend(double x, double centre, double width) {
    const double s = std::clamp((x - centre) / width + 0.5, 0.0, 1.0);
    return static_cast<float>(s * s * (3.0 - 2.0 * s));
}

// Arc cosine of x in [-1, 1], degrees, to 2e-6 degrees: Abramowitz and Stegun 4.4.46.
double arc_cosine_deg(double x) {
    const double y = std::abs(x), y2 = y * y, y4 = y2 * y2;
    const double low = 1.5707963050 - 0.2145988016 * y + (0.0889789874 - 0.0501743046 * y) * y2;
    const double high = 0.0308918810 - 0.0170881256 * y + (0.0066700901 - 0.0012624911 * y) * y2;
    const double angle = std::sqrt(1.0 - y) * (low + high * y4) * (180.0 / std::numbers::pi);
    return x < 0.0 ? 180.0 - angle : angle;
}

}  // namespace

TerrainShader::TerrainShader(const scene::Material& material, const scene::Sun& sun, const scene::Sky& sky)
    : material_(material),
      low_(material.low),
      rise_(material.high - material.low),
      steep_(material.steep),
      sun_(sun.colour * (sun.intensity / std::numbers::pi)),
      open_sky_(ambient_light(sky, 1.0)),
      ground_(ambient_light(sky, -1.0)),
      sunward_sky_(sun.intensity > 0.0 ? kSunwardSky : 0.0) {}

glm::vec3 TerrainShader::albedo(double height, double slope_cosine) const {
    const double slope_deg = arc_cosine_deg(std::clamp(slope_cosine, -1.0, 1.0));
    const glm::vec3 gentle = low_ + rise_ * blend(height, material_.band_height, material_.band_width);
    const float steep = blend(slope_deg, material_.steep_deg, material_.steep_width_deg);
    return gentle * (1.0f - steep) + steep_ * steep;
}

glm::vec3 TerrainShader::radiance(const SurfacePoint& point) const {
    const double n_dot_sun = std::clamp(point.n_dot_sun, -1.0, 1.0);
    const glm::vec3 sunlight(sun_ * (std::max(n_dot_sun, 0.0) * point.sun_visibility));
    const auto seen_sky = static_cast<float>(0.5 + 0.5 * std::clamp(point.up_dot_normal, -1.0, 1.0));
    const glm::vec3 even = ground_ * (1.0f - seen_sky) + open_sky_ * seen_sky;
    const glm::vec3 skylight = even * static_cast<float>(1.0 + sunward_sky_ * n_dot_sun);
    return albedo(point.height, point.up_dot_normal) * (sunlight + skylight);
}

}  // namespace strata::shaders
