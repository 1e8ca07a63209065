// Straight edge: black on one side, white on the other. The simplest picture that aliases, and the discontinuity that
// decides how fast samples converge on anything with silhouettes.
//
//   angle_deg  direction of the white side from the frame's centre, counter-clockwise from right on the screen   30
//   offset     of the edge from the frame's centre in that direction, pixels                                     0
//
//   [edge]
//   angle_deg = 30.0
//   offset = 0.0
#pragma once

#include "src/scene/scene.h"

namespace strata::shaders {

// Linear grey, 0 or 1 (1 on the edge itself), at (u, v) pixels of a width x height frame. Still: t is not used.
float edge(const scene::Edge& parameters, int width, int height, double u, double v, double t);

}  // namespace strata::shaders
