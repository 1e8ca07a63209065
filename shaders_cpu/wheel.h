// Spoked wheel: black on white, in the middle of the frame, turning counter-clockwise on the screen.
//
//   spokes       evenly spread                                                 12
//   turns_per_s  speed, counter-clockwise; negative: clockwise                 0.5
//   spoke_fill   fraction of the angle that is spoke, the same at any radius   0.4
//
//   [wheel]
//   spokes = 12
//   turns_per_s = 1.9
//   spoke_fill = 0.4
//
// At t = 0 a spoke points right. The picture repeats every 1 / (spokes * turns_per_s) seconds. Averaged over that time
// the spokes are an even disc. After figure 8 of Gamito & Maddock 2006; numbers and shape are chosen.
#pragma once

#include "src/scene/scene.h"

namespace strata::shaders {

// Radii as fractions of half the frame's nearer side.
inline constexpr double kWheelRadius = 0.9;
inline constexpr double kWheelRimInside = 0.8;
inline constexpr double kWheelHubRadius = 0.15;

// Linear grey, 0 (wheel) or 1, at (u, v) pixels of a width x height frame and time t in seconds.
float wheel(const scene::Wheel& parameters, int width, int height, double u, double v, double t);

}  // namespace strata::shaders
