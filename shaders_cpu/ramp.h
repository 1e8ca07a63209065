// Even ramp: grey that rises linearly in one direction. Every symmetric filter leaves it as it is, so what differs is
// the estimator's error alone.
//
//   angle_deg  direction of the rise, counter-clockwise from right on the screen   30
//   rise       over a length of the frame's width; the frame's centre is 1/2       1
//
//   [ramp]
//   angle_deg = 30.0
//   rise = 1.0
#pragma once

#include "src/scene/scene.h"

namespace strata::shaders {

// Linear grey, of any sign, at (u, v) pixels of a width x height frame. Still: t is not used.
float ramp(const scene::Ramp& parameters, int width, int height, double u, double v, double t);

}  // namespace strata::shaders
