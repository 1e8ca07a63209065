// Stage of a surface's picture: what the media between the eye and what was hit take and add.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// chunk.radiance of the hits comes out as the eye sees it.
void apply_medium(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
