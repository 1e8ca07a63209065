#pragma once

#include <cmath>

namespace strata::shaders {

// An evenly bright disc of angular radius a whose irradiance on a plane that faces it is 1 has radiance 1 / (pi sin^2
// a) over 2 pi (1 - cos a) steradians. A direction drawn evenly from it therefore stands for an irradiance of this
// times its cosine: 2 (1 - cos a) / sin^2 a = 2 / (1 + cos a). Exactly 1 for a = 0.
inline double disc_factor(double radius) { return 2.0 / (1.0 + std::cos(radius)); }

}  // namespace strata::shaders
