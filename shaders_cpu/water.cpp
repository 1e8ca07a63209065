#include "shaders_cpu/water.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shaders_cpu/water_optics.h"

namespace strata::shaders {

namespace {

constexpr double kIndex2 = kWaterIndex * kWaterIndex;

double sight_of(const glm::dvec3& absorption) {
    const double least = std::min({absorption.x, absorption.y, absorption.z});
    return least > 0.0 ? std::log(4096.0) / least : std::numeric_limits<double>::infinity();
}

}  // namespace

Water::Water(const scene::Scene& scene)
    : metres_(scene.scale.metres),
      level_(scene.water.level_m / metres_),
      sight_(sight_of(scene.water.absorption * metres_)),
      absorption_(scene.water.absorption * metres_),
      deep_(scene.water.deep),
      waves_(scene.water.wind_m_s, scene.water.waves_m / metres_) {}

// Nothing is taken by water that takes nothing, however long the way.
glm::vec3 Water::left_after(double way) const {
    glm::vec3 left(1.0f);
    for (int c = 0; c < 3; ++c)
        if (absorption_[c] > 0.0) left[c] = static_cast<float>(std::exp(-absorption_[c] * std::max(way, 0.0)));
    return left;
}

// Light spreads to 1 / n^2 of its radiance as it leaves the water; (1 - reflected) / n^2 = 1 - kept.
glm::vec3 Water::even_light_at(double depth) const {
    return static_cast<float>(1.0 - even_light_kept()) * left_after(kEvenLightPath * depth);
}

// A beam of cosine c comes in as 1 - fresnel(c) of its light, on c / c' of the area across it.
glm::vec3 Water::beam_at(const glm::dvec3& to_light, double depth) const {
    if (to_light.y <= 0.0) return glm::vec3(0.0f);
    const double below = -refracted(-to_light, {0.0, 1.0, 0.0}).y;
    const double share = (1.0 - fresnel(to_light.y)) * to_light.y / (below * kIndex2);
    return static_cast<float>(share) * left_after(depth / below);
}

glm::vec3 Water::again_and_again(const glm::vec3& reflectance, double depth) const {
    const glm::vec3 back =
        reflectance * static_cast<float>(even_light_kept()) * left_after(2.0 * kEvenLightPath * depth);
    return 1.0f / (1.0f - back);
}

// As a bed of that reflectance right under the face would be, less what is hidden behind the bed that there is.
glm::vec3 Water::own_colour(const glm::vec3& white, double way, double depth) const {
    const glm::vec3 seen = deep_ * even_light_at(0.0) * again_and_again(deep_, 0.0) * white;
    return seen * (glm::vec3(1.0f) - left_after(way + kEvenLightPath * depth));
}

}  // namespace strata::shaders
