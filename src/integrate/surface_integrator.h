// From a batch of samples to their radiance, chunk by chunk through the stages of place.h, cull.h, trace_rays.h,
// resolve.h, light.h, water.h, medium.h and fill_channels.h.
#pragma once

#include "src/integrate/cull.h"

namespace strata::integrate {

// One each thread.
struct SurfaceWork {
    CulledBatch batch;
    SurfaceChunk chunk;
};

// Puts the radiance of a chunk where the batch's samples have it.
void put_back(const SurfaceChunk& chunk, std::span<glm::vec3> radiance, Counters& counters);

void integrate_surface(const SurfaceSetup& setup, const SampleBatch& samples, const SampleOut& out, SurfaceWork& work,
                       Counters& counters);

}  // namespace strata::integrate
