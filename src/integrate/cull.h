// Stage of a surface's picture: what rays need not be followed through. Beams around the cells of the screen are
// followed once a batch, and windows opened where they met something; its samples are then taken chunk by chunk in the
// order of their cells.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Rays traced at once: enough to keep packets full, few enough for their data to stay in the second-level cache.
inline constexpr std::size_t kChunk = 4096;

// A batch of samples, and the part of it that is at work. Memory is reused from batch to batch.
struct CulledBatch {
    accel::BeamedSamples beamed;
    std::size_t first_cell = 0, last_cell = 0;  // beamed.cells [first_cell, last_cell) are at work,
    std::size_t first = 0, last = 0;            // and of their samples beamed.samples.order [first, last)
};

// Follows the beams. Without beams (the reference tracer's case) all samples are of one cell, of which nothing is
// known.
void follow_beams(const SurfaceSetup& setup, const SampleBatch& samples, CulledBatch& batch, Counters& counters);

// The next chunk of the batch, of kChunk samples at most: chunk.order. False: there is none.
bool next_chunk(CulledBatch& batch, SurfaceChunk& chunk);

// Lets each ray begin where its cell's beam ended, and names the windows of its cell: chunk.windowed.
void cull_rays(const SurfaceSetup& setup, CulledBatch& batch, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
