// Light on a surface, from all of the sky at once.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>

namespace strata::shaders {

// Real spherical harmonics up to the second degree of a radiance, times the cosine lobe's (Ramamoorthi and Hanrahan
// 2001: pi, 2 pi / 3, pi / 4 by degree): what is left out is a few per cent of the irradiance.
class SkyIrradiance {
  public:
    // Of radiance(x, y, z) between two values of y.
    SkyIrradiance(const std::function<glm::dvec3(const glm::dvec3&)>& radiance, double lowest_y, double highest_y);

    // Lux on each channel, for a unit normal; never negative.
    glm::dvec3 at(const glm::dvec3& normal) const;

    const std::array<glm::dvec3, 9>& coefficients() const { return coefficients_; }

  private:
    std::array<glm::dvec3, 9> coefficients_{};
};

}  // namespace strata::shaders
