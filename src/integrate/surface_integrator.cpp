#include "src/integrate/surface_integrator.h"

#include <algorithm>

#include "src/integrate/fill_channels.h"
#include "src/integrate/light.h"
#include "src/integrate/medium.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/place.h"
#include "src/integrate/resolve.h"
#include "src/integrate/trace_rays.h"
#include "src/integrate/water.h"

namespace strata::integrate {

void put_back(const SurfaceChunk& chunk, std::span<glm::vec3> radiance, Counters& counters) {
    PhaseMeter meter(counters);
    for (std::size_t i = 0; i < chunk.order.size(); ++i) radiance[chunk.order[i]] = chunk.radiance[i];
    meter.book(Phase::shading);
}

void integrate_surface(const SurfaceSetup& setup, const SampleBatch& samples, const SampleOut& out, SurfaceWork& work,
                       Counters& counters) {
    SurfaceChunk& chunk = work.chunk;
    chunk.reserve(std::min(kChunk, samples.u.size()), setup.field.drifts(), setup.has_shadows);
    follow_beams(setup, samples, work.batch, counters);
    while (next_chunk(work.batch, chunk)) {
        place_rays(setup, samples, chunk, counters);
        cull_rays(setup, work.batch, chunk, counters);
        stop_at_water(setup, chunk);
        trace_rays(setup, chunk, counters);
        find_water(setup, chunk);
        resolve_hits(setup, chunk, counters);
        light_hits(setup, chunk, counters);
        light_water(setup, chunk, counters);
        apply_medium(setup, chunk, counters);
        fill_channels(setup, samples, chunk, out);
        put_back(chunk, out.radiance, counters);
    }
}

}  // namespace strata::integrate
