// Zone plate: concentric rings whose frequency grows in proportion to the radius, so that each place of the picture
// holds one frequency in one direction, and a filter shows what it does to all of them at once.
//
//   I = 1/2 + 1/2 cos(2 pi rings (r / R)^2),   R half of the frame's nearer side, r from the frame's centre
//
//   rings   periods from the centre to R; the local frequency there is 2 rings / R.
//           0: R / 4, which makes it Nyquist's half cycle a pixel.
//
//   [zoneplate]
//   rings = 0.0
//
// The choice for figure 4 of Gamito & Maddock 2006, whose own pattern is lost.
#pragma once

#include "src/scene/scene.h"

namespace strata::shaders {

// Linear grey in [0,1] at (u, v) pixels of a width x height frame. Still: t is not used.
float zoneplate(const scene::Zoneplate& parameters, int width, int height, double u, double v, double t);

}  // namespace strata::shaders
