// How a rough surface spreads light, against Lambert's even spread: Oren and Nayar's facets in Fujii's form, made to
// lose nothing by Portsmouth, Kutz and Hill, "EON: A practical energy-preserving rough diffuse BRDF", JCGT 14 (2025),
// equations of sections 2 and 3 for albedo 1. Albedo multiplies it, so that it stays what is reflected of even light.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "shaders_cpu/arc_cosine.h"

namespace strata::shaders {

class RoughLobe {
  public:
    // roughness in [0,1]; 0 is Lambert: 1 for all directions.
    explicit RoughLobe(double roughness) : a_(1.0 / (1.0 + kA * roughness)), b_(roughness * a_) {}

    // BRDF times pi of a white surface; unit vectors; 0 for light from below the surface. Its mean over directions of
    // light, by the cosine, is 1 for every direction of the eye. An eye below is taken for one that grazes: normals
    // have detail finer than hits, and some of what is seen is turned away from the eye by it.
    double operator()(const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& to_eye) const {
        const double in = std::min(glm::dot(normal, to_light), 1.0);
        if (in <= 0.0) return 0.0;
        const double out = std::clamp(glm::dot(normal, to_eye), kGrazing, 1.0);
        const double s = glm::dot(to_light, to_eye) - in * out;
        const double single = a_ + b_ * (s > 0.0 ? s / std::max(in, out) : s);
        const double mean_lost = 1.0 - a_ - b_ * kMean;
        if (mean_lost <= 0.0) return std::max(single, 0.0);  // roughness 0
        return std::max(single, 0.0) + lost(in) * lost(out) / mean_lost;
    }

  private:
    static constexpr double kGrazing = 1e-3;  // cosine
    static constexpr double kA = 0.5 - 2.0 / (3.0 * std::numbers::pi);
    static constexpr double kMean = 2.0 / 3.0 - 28.0 / (15.0 * std::numbers::pi);

    // What single reflection leaves out of light from a direction of the given cosine.
    double lost(double cosine) const {
        const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
        const double g = sine * (arc_cosine_deg(cosine) * (std::numbers::pi / 180.0) - sine * cosine) +
                         2.0 / 3.0 * (sine / cosine * (1.0 - sine * sine * sine) - sine);
        return 1.0 - a_ - b_ * g * std::numbers::inv_pi;
    }

    double a_, b_;
};

}  // namespace strata::shaders
