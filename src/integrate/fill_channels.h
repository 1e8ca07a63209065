// Stage of a surface's picture: what is asked for beside radiance.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// The values of out.channels for the samples of a chunk of the batch, which went through all stages before.
void fill_channels(const SurfaceSetup& setup, const SampleBatch& batch, const SurfaceChunk& chunk,
                   const SampleOut& out);

// Those of a picture that traces nothing, from its radiance.
void fill_channels(const SampleOut& out);

}  // namespace strata::integrate
