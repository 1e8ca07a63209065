// Stage of a surface's picture: what the media between the eye and what was hit take and add.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// What the eye looks along of a sample, up to a distance.
inline shaders::MediumRay medium_ray(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t sample,
                                     double distance) {
    const trace::Ray& ray = chunk.rays[sample];
    return {.origin = ray.origin,
            .direction = chunk.view_of(sample),
            .distance = distance,
            .pixel = ray.delta_slope / setup.scene.sampling.tolerance,
            .time = chunk.time_of(sample),
            .shaft = chunk.in_fog.empty() ? glm::vec3(0.0f) : chunk.in_fog[sample]};
}

// chunk.radiance of the hits comes out as the eye sees it.
void apply_medium(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
