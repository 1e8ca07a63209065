// Stage of a surface's picture: level water (shaders_cpu/water.h). Rays from above end on it where no surface lies
// before; what they see there goes up as a mirrored and down as a refracted ray, which are followed, resolved and lit
// as the eye's rays are.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Ends the chunk's rays on the water: chunk.to_water. Before they are traced, so that nothing behind is looked for; and
// after, what met no surface before: HitState::water. Nothing is done where the scene has no water.
void stop_at_water(const SurfaceSetup& setup, SurfaceChunk& chunk);
void find_water(const SurfaceSetup& setup, SurfaceChunk& chunk);

// The radiance of the rays that ended on water: chunk.water, and in chunk.radiance, which light_hits made.
void light_water(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

// The same of rays that are themselves light on the ground: what calm water mirrors of the open sky, and nothing from
// below it.
void mirror_open_sky(const SurfaceSetup& setup, SurfaceChunk& chunk);

// Shadow rays from under water, as far as its face; and beyond it from there on, those of light l that are not stopped,
// from the first-th on: appended to chunk.shadow.
void stop_at_face(const SurfaceSetup& setup, std::span<trace::Ray> rays);
void go_on_over_water(const SurfaceSetup& setup, std::size_t l, std::size_t first, SurfaceChunk& chunk);

}  // namespace strata::integrate
