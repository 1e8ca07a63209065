// Stage of a surface's picture: the light that leaves what each ray met, sun and its shadows, and the sky.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Rays that no tracer could settle within its step limit are drawn in this colour, to be seen.
inline constexpr glm::vec3 kUnresolvedRadiance{1.0f, 0.0f, 1.0f};

// All hits see the sun.
void clear_shadows(SurfaceChunk& chunk);

// Follows rays from the hits to the sun: chunk.visibility.
void cast_shadows(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

// From chunk.visibility to chunk.radiance.
void shade(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

// Both, of shadows only those that the scene has.
void light_hits(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
