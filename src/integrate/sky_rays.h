// Part of the stage of light.h: light of the sky, and what other ground reflects of sun and sky.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Follows one ray from each hit into the hemisphere over it: chunk.light. A ray that meets nothing brings the
// background's light; one that meets the surface brings what that point sends on, if scene.sky.bounces allows: it is
// lit as chunk's hits are, with shadow rays and a sky ray of its own. The medium lies between the eye and the surface
// only.
void gather_sky(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
