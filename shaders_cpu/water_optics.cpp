#include "shaders_cpu/water_optics.h"

#include <algorithm>
#include <cmath>

namespace strata::shaders {

double fresnel(double cosine) {
    const double in = std::clamp(cosine, 0.0, 1.0);
    const double below = std::sqrt(1.0 - (1.0 - in * in) / (kWaterIndex * kWaterIndex));
    const double across = (in - kWaterIndex * below) / (in + kWaterIndex * below);
    const double along = (below - kWaterIndex * in) / (below + kWaterIndex * in);
    return 0.5 * (across * across + along * along);
}

glm::dvec3 refracted(const glm::dvec3& direction, const glm::dvec3& normal) {
    const double in = std::clamp(-glm::dot(direction, normal), 0.0, 1.0);
    const double below = std::sqrt(1.0 - (1.0 - in * in) / (kWaterIndex * kWaterIndex));
    return glm::normalize(direction / kWaterIndex + (in / kWaterIndex - below) * normal);
}

glm::dvec3 out_of_water(const glm::dvec3& direction) {
    const glm::dvec3 level = kWaterIndex * glm::dvec3(direction.x, 0.0, direction.z);
    const double rest = 1.0 - glm::dot(level, level);
    return glm::normalize(level + glm::dvec3(0.0, std::sqrt(std::max(rest, 0.0)), 0.0));
}

namespace {

// The integral of 2 c fresnel(c) over c in [0,1], by Simpson's rule in the square root of c, in which it is smooth:
// c = q^2, dc = 2 q dq.
double reflected_by_quadrature() {
    constexpr int kSteps = 512;
    const auto integrand = [](double q) { return 4.0 * q * q * q * fresnel(q * q); };
    double sum = integrand(0.0) + integrand(1.0);
    for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * integrand(static_cast<double>(i) / kSteps);
    return sum / (3.0 * kSteps);
}

}  // namespace

double even_light_reflected() {
    static const double share = reflected_by_quadrature();
    return share;
}

double even_light_kept() { return 1.0 - (1.0 - even_light_reflected()) / (kWaterIndex * kWaterIndex); }

}  // namespace strata::shaders
