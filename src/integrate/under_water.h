// Part of the stage of water.h: what is seen through the water.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// How far any ray is followed, surface units.
double farthest(const SurfaceSetup& setup);

// Of the chunk that it is of.
std::vector<std::uint32_t> samples_of(const std::vector<WaterHit>& water);

// From a point of the water on, up or down, with the tolerance of the ray that came there.
trace::Ray ray_from_water(const SurfaceChunk& chunk, const WaterHit& hit, const glm::dvec3& direction);

// chunk.bed: the refracted rays of chunk.water and the light that comes along them to the face, but for fresnel's
// share. What floats in the water is lit by chunk.face, which light_face lit.
void follow_refracted(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
