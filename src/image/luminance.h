// How bright linear light of Rec. 709's primaries looks.
#pragma once

#include <glm/glm.hpp>

namespace strata::image {

// Reflects 18 % of the light: what a curve holds in place.
inline constexpr double kMidGrey = 0.18;

// Rec. ITU-R BT.709-6, item 3.2: 0.2126, 0.7152 and 0.0722.
inline double luminance(const glm::dvec3& light) { return 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b; }

// Away from the grey of the same luminance, or with saturation < 1 towards it.
inline glm::dvec3 saturated(const glm::dvec3& light, double saturation) {
    const double grey = luminance(light);
    return grey + (light - grey) * saturation;
}

}  // namespace strata::image
