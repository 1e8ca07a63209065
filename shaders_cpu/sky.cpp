#include "shaders_cpu/sky.h"

#include <algorithm>
#include <cmath>

namespace strata::shaders {
namespace {

constexpr double kGroundReflectance = 0.2;

glm::vec3 mix_sky(const scene::Sky& sky, double weight) {
    return glm::vec3(sky.zenith + (sky.horizon - sky.zenith) * weight);
}

}  // namespace

double horizon_weight(double direction_y) {
    const double y = std::clamp(direction_y, 0.0, 1.0);
    const double cos2 = 1.0 - y * y;
    const double cos4 = cos2 * cos2;
    const double cos8 = cos4 * cos4;
    return cos8 * cos8;
}

glm::vec3 sky_radiance(const scene::Sky& sky, const glm::dvec3& direction) {
    return mix_sky(sky, horizon_weight(direction.y));
}

glm::vec3 ambient_light(const scene::Sky& sky, double up_dot_normal) {
    // The mean of cos^16 over the hemisphere by the cosine to its pole: integral of 2 y (1 - y^2)^8 over [0,1].
    constexpr double kMeanHorizonWeight = 1.0 / 9.0;
    const double up = std::clamp(up_dot_normal, -1.0, 1.0);
    const double seen_sky = 0.5 * (1.0 + up);
    return mix_sky(sky, kMeanHorizonWeight) * static_cast<float>(seen_sky + kGroundReflectance * (1.0 - seen_sky));
}

}  // namespace strata::shaders
