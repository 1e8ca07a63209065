// From a batch of samples to their radiance, chunk by chunk through the stages of place.h, cull.h, trace_rays.h,
// resolve.h, light.h, medium.h and channels.h.
#pragma once

#include "src/integrate/cull.h"

namespace strata::integrate {

// One each thread.
struct SurfaceWork {
    CulledBatch batch;
    SurfaceChunk chunk;
};

// Puts what the stages found of a chunk where the batch's samples have it. costs: empty if not asked for.
void put_back(const SurfaceChunk& chunk, std::span<glm::vec3> radiance, std::span<SampleCost> costs,
              Counters& counters);

// costs: empty if not asked for.
void integrate_surface(const SurfaceSetup& setup, const SampleBatch& samples, std::span<glm::vec3> radiance,
                       std::span<SampleCost> costs, SurfaceWork& work, Counters& counters);

}  // namespace strata::integrate
