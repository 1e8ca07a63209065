#include "shaders_cpu/cloud_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strata::shaders {

namespace {

constexpr double kBackward = 0.75 * (1.0 - 0.85);  // droplets' mean cosine is 0.85

double lobe(double cosine, double g) {
    const double d = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * std::numbers::pi * d * std::sqrt(d));
}

// Two lobes in place of Mie's: forward, and the little that goes back. Its mean cosine is 0.59, less than droplets
// have, since light that a first turn has hardly deflected is here as well.
double droplet_phase(double cosine) { return 0.75 * lobe(cosine, 0.8) + 0.25 * lobe(cosine, -0.05); }

// Mean of exp(-t) over an optical depth: what light that comes back after one turn has gone through.
double mean_clear(double t) { return t > 1e-6 ? -std::expm1(-t) / t : 1.0 - 0.5 * t; }

// The same of light that goes on: exp(-t) of all of it over the opacity, t / (exp(t) - 1). It is hardly turned again by
// what it meets, so that half of the depth counts.
double mean_clear_onward(double t) { return t > 1e-6 ? 0.5 * t / std::expm1(0.5 * t) : 1.0 - 0.25 * t; }

}  // namespace

double cloud_transmission(double depth) { return 1.0 / (1.0 + kBackward * depth); }

glm::vec3 cloud_radiance(const CloudSky& sky, const CloudSight& sight, double depth, double sun_depth) {
    const double slanted = sun_depth / sight.sun_cosine;
    const double once = std::numbers::pi * droplet_phase(sight.cosine_turn) *
                        (sight.sun_is_beyond ? mean_clear_onward(slanted) : mean_clear(slanted));
    // What went through is not scattered, and what left after one turn is in `once`. On the lit side lies shade where
    // the cloud towards the sun is higher.
    const double rest = -std::expm1(-slanted) * (1.0 - mean_clear(slanted));
    const double shade = std::exp(-0.25 * std::max(sun_depth - depth, 0.0));
    const double often =
        rest * (sight.sun_is_beyond ? cloud_transmission(sun_depth) : (1.0 - cloud_transmission(depth)) * shade);
    const glm::vec3& before = sight.from_below ? sky.below : sky.above;
    const glm::vec3& beyond = sight.from_below ? sky.above : sky.below;
    const double hidden = -std::expm1(-depth);
    const auto through = static_cast<float>(hidden * cloud_transmission(depth) + (1.0 - hidden) * 0.5);
    return sky.sun * static_cast<float>(once + sight.sun_cosine * often) + beyond * through + before * (1.0f - through);
}

}  // namespace strata::shaders
