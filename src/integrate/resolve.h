// Stage of a surface's picture: where the rays that hit did so, and how the surface lies there.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Outward unit normals of hits in the surface's coordinates: `x` are their positions, noise_shift that of their rays,
// or empty where nothing drifts.
void find_normals(const SurfaceSetup& setup, std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                  std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> normal, trace::TraceCounters& counters);

// Gathers the samples that hit, with their normals.
void resolve_hits(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
