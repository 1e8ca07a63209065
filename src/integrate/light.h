// Stage of a surface's picture: the light that leaves what each ray met, from every light that it sees; and the
// background of rays that met nothing.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/shadows.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Rays that no tracer could settle within its step limit are drawn in this colour, to be seen.
inline constexpr glm::vec3 kUnresolvedRadiance{1.0f, 0.0f, 1.0f};

// A hit of a chunk that went through illuminate, as materials and lights see it; of no light.
inline shaders::ShadingPoint shading_point(const SurfaceChunk& chunk, std::size_t hit) {
    return {.x = chunk.x[hit],
            .normal = glm::dvec3(chunk.normal[hit]),
            .height = chunk.height[hit],
            .up_dot_normal = chunk.up_dot_normal[hit],
            .time = chunk.time_of(chunk.sample[hit])};
}

// From chunk.visibility to chunk.light.
void illuminate(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

// From chunk.light to chunk.radiance, of rays that met nothing as well.
void shade(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

// Shadows and sky rays, those that the scene has, illuminate and shade.
void light_hits(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
