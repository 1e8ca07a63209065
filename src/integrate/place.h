// Stage of a surface's picture: the camera's rays, where camera, surface and lights are at each sample's own time.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// The camera where it is at a time, in the world.
trace::Camera camera_at(const SurfaceSetup& setup, double t);

// The camera's ray through a point of the screen at a time, in the world, with the scene's tolerance.
trace::Ray camera_ray(const SurfaceSetup& setup, double u, double v, double t);

// The same in the surface's coordinates, to the bit as the picture has it.
trace::Ray local_camera_ray(const SurfaceSetup& setup, double u, double v, double t);

// Rays, their view and the lights' directions of the samples chunk.order of a batch.
void place_rays(const SurfaceSetup& setup, const SampleBatch& samples, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
