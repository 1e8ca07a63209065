// Part of the stage of light.h: which lights each hit sees.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Draws the point of each light's disc that each hit is lit from, where lights have discs: chunk.to_disc.
void choose_disc_points(const SurfaceSetup& setup, SurfaceChunk& chunk);

// All hits see all lights.
void clear_shadows(SurfaceChunk& chunk);

// Follows rays from the hits to the lights that cast shadows: chunk.visibility.
void cast_shadows(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
