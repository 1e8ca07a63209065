#pragma once

#include "src/trace/field.h"

namespace strata::accel {

// Radius of a ball about the surface's origin that holds all that is solid, a little padded; infinite for terrains.
double bounding_ball(const trace::Field& field);

}  // namespace strata::accel
