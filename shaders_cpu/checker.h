// Checkered plane: black and white squares on an endless level plane, seen in perspective by a level eye, under an even
// grey sky. From squares of many pixels to none within one picture: the classic trial of an antialiasing filter.
//
//   square    side of a square, world units                                  1
//   height    of the eye over the plane, world units                         1
//   horizon   where it lies, fraction of the frame's height from the top     0.3
//
//   [checker]
//   square = 1.0
//   height = 1.0
//   horizon = 0.3
//
// The focal length is the frame's width (a horizontal field of view of 53.13 degrees). The eye stands over the line
// between two columns of squares. The sky is the mean of the squares, so that a perfect filter shows no horizon. The
// choice for figure 4 of Gamito & Maddock 2006, whose own pattern is lost.
#pragma once

#include "src/scene/scene.h"

namespace strata::shaders {

// Linear grey at (u, v) pixels of a width x height frame: 0 or 1 on the plane; 0.5 above it, and where squares are so
// far that a double cannot count them. Still: t is not used.
float checker(const scene::Checker& parameters, int width, int height, double u, double v, double t);

}  // namespace strata::shaders
