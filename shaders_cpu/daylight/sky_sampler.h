// Directions into the sky, more where more light comes from.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace strata::shaders {

struct SkySample {
    glm::dvec3 direction;
    double pdf;  // per steradian
};

// A density over the upper hemisphere, constant in cells of equal solid angle: luminance times the cosine to the
// vertical, with a fifth added to the cosine, without which a wall, lit by the horizon, would be nothing but noise. A
// hundredth of all samples are even, so that the density is nowhere 0.
class SkySampler {
  public:
    explicit SkySampler(const std::function<double(const glm::dvec3&)>& luminance);

    // u0, u1 in [0,1).
    SkySample sample(double u0, double u1) const;

    // Of a unit direction; 0 below y = 0.
    double pdf(const glm::dvec3& direction) const;

  private:
    std::vector<double> probability_;  // of a cell: by y, then by azimuth
    std::vector<double> rows_;         // cumulated
    std::vector<double> in_row_;       // cumulated within each row, which ends at 1
};

}  // namespace strata::shaders
