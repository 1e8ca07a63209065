#include "shaders_cpu/daylight/sky_irradiance.h"

#include <cmath>
#include <numbers>

namespace strata::shaders {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRings = 96;
constexpr int kAround = 96;

std::array<double, 9> harmonics(const glm::dvec3& d) {
    const double first = std::sqrt(3.0 / (4.0 * kPi));
    const double second = std::sqrt(15.0 / (4.0 * kPi));
    return {std::sqrt(1.0 / (4.0 * kPi)),
            first * d.x,
            first * d.y,
            first * d.z,
            second * d.x * d.y,
            second * d.y * d.z,
            second * d.x * d.z,
            second * 0.5 * (d.x * d.x - d.z * d.z),
            std::sqrt(5.0 / (16.0 * kPi)) * (3.0 * d.y * d.y - 1.0)};
}

}  // namespace

SkyIrradiance::SkyIrradiance(const std::function<glm::dvec3(const glm::dvec3&)>& radiance, double lowest_y,
                             double highest_y) {
    // Rings crowd where both ends may have a bright edge: y = lowest + reach (3 x^2 - 2 x^3).
    const double reach = highest_y - lowest_y;
    for (int k = 0; k < kRings; ++k) {
        const double x = (k + 0.5) / kRings;
        const double y = lowest_y + reach * x * x * (3.0 - 2.0 * x);
        const double solid_angle = reach * 6.0 * x * (1.0 - x) / kRings * 2.0 * kPi / kAround;
        const double level = std::sqrt(std::max(0.0, 1.0 - y * y));
        for (int a = 0; a < kAround; ++a) {
            const double azimuth = 2.0 * kPi * (a + 0.5) / kAround;
            const glm::dvec3 direction(level * std::cos(azimuth), y, level * std::sin(azimuth));
            const glm::dvec3 light = radiance(direction) * solid_angle;
            const std::array<double, 9> basis = harmonics(direction);
            for (int i = 0; i < 9; ++i) coefficients_[i] += light * basis[i];
        }
    }
    for (int i = 0; i < 9; ++i) coefficients_[i] *= i == 0 ? kPi : i < 4 ? 2.0 * kPi / 3.0 : kPi / 4.0;
}

glm::dvec3 SkyIrradiance::at(const glm::dvec3& normal) const {
    const std::array<double, 9> basis = harmonics(normal);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 9; ++i) sum += coefficients_[i] * basis[i];
    return glm::max(sum, glm::dvec3(0.0));
}

}  // namespace strata::shaders
