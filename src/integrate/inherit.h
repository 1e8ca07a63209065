// Samples of rays that go on from where others ended.
#pragma once

#include <cstdint>
#include <span>

#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// What the samples of `next` have of those that they start from, `samples` of chunk's: the ids of their random
// dimensions, the sky's axes and the directions of lights.
void inherit(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::span<const std::uint32_t> samples,
             SurfaceChunk& next);

}  // namespace strata::integrate
