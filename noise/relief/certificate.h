// What is known of a relief everywhere: the bounds that tracers, clips and checks of the scene rest on.
#pragma once

#include <algorithm>
#include <cmath>

namespace strata::noise {

// Bounds of a relief r over its whole domain. Lengths in the relief's units.
struct Certificate {
    double low = 0.0;    // r >= low
    double high = 0.0;   // r <= high
    double slope = 0.0;  // Lipschitz constant of r
    double bend = 0.0;   // Lipschitz constant of r's gradient; infinite where the gradient jumps

    double size() const { return std::max(std::abs(low), std::abs(high)); }
};

}  // namespace strata::noise
