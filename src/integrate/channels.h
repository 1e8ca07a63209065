// Stage of a surface's picture: what is asked for beside radiance.
#pragma once

#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// chunk.costs: what each sample's ray, its normal and its shadow ray took.
void fill_channels(const SurfaceSetup& setup, SurfaceChunk& chunk);

}  // namespace strata::integrate
