// Stage of a surface's picture: the first point of each ray that is solid.
#pragma once

#include "src/integrate/image_function.h"
#include "src/integrate/surface_chunk.h"
#include "src/integrate/surface_setup.h"

namespace strata::integrate {

// Traces any rays in the surface's coordinates by the tracer that was asked for.
void trace_rays(const SurfaceSetup& setup, std::span<const trace::Ray> rays, std::span<trace::Hit> hits,
                trace::TraceCounters& counters);

void trace_rays(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters);

}  // namespace strata::integrate
