// Part of the stage of medium.h: what hides the sun from the fog.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// The fog has none.
void clear_shafts(SurfaceChunk& chunk);

// Follows a ray to the sun from one place in the fog before each ray's end: chunk.in_fog. There is fog with shafts.
void cast_shafts(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
