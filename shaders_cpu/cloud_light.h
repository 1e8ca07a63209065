// What a layer of clouds sends on of the light that falls on it.
//
// Light that is scattered often is that of the two-stream approximation for droplets that absorb nothing: of an optical
// depth t the share g t / (1 + g t) comes back and the rest goes through, g = (1 - mean cosine of scattering) 3/4
// (Bohren 1987, "Multiple scattering of light and some of its observable consequences"). Light that is scattered once
// keeps the droplets' forward lobe, which is the silver rim about the sun.
#pragma once

#include <glm/glm.hpp>

namespace strata::shaders {

// What falls on a layer: radiance of white that faces the sun, and of white under all that is above, or below.
struct CloudSky {
    glm::vec3 sun, above, below;
};

struct CloudSight {
    bool from_below;     // the eye
    bool sun_is_beyond;  // it lights the other side than that which is seen
    double sun_cosine;   // to the layer's vertical, in (0, 1]
    double cosine_turn;  // of the angle by which its light turns towards the eye
};

// Share of the light that goes through an optical depth, straight on or scattered.
double cloud_transmission(double depth);

// Radiance of an opaque piece of cloud of an optical depth, which the sun's light has another one to go through.
glm::vec3 cloud_radiance(const CloudSky& sky, const CloudSight& sight, double depth, double sun_depth);

}  // namespace strata::shaders
