// Part of the stage of water.h: the light of lamps on the water's face.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// chunk.face: the water of chunk.water as a level surface, and what light a white one would send on there, for what
// floats below it. Of the sun, as waves mirror it: chunk.water's radiance.
void light_face(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
