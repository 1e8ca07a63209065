// Where two pictures differ, in colours that keep their order without hue: inferno, dark to light.
#pragma once

#include <string>

#include "src/image/canvas.h"
#include "src/image/picture.h"
#include "src/image/text.h"

namespace strata::image {

// Each pixel's distance, sqrt of the mean square of its three channels' differences in linear radiance, from black (0)
// to pale yellow (top > 0 and beyond). Colours follow the distance's square root, so that a hundredth of the top still
// shows. Where either picture is not finite: kNotFiniteColour, which the scale does not have. Throws ImageError unless
// the sizes are equal.
Canvas difference(const Picture& picture, const Picture& reference, double top);

// A top of 1, 2 or 5 times a power of ten, the least from `value` up: 0.037 -> 0.05. 1 for what is no positive number.
double scale_top(double value);

// The scale that difference() uses, as a bar with numbers, `width` >= 200 pixels wide; below it `label`, wrapped.
Canvas difference_scale(int width, double top, const std::string& label = "difference in linear radiance");

}  // namespace strata::image
