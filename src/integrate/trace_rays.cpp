#include "src/integrate/trace_rays.h"

#include "src/integrate/phase_meter.h"
#include "src/trace/reference_tracer.h"

namespace strata::integrate {

void trace_rays(const SurfaceSetup& setup, std::span<const trace::Ray> rays, std::span<trace::Hit> hits,
                trace::TraceCounters& counters) {
    if (setup.tracer == Tracer::reference) return trace::trace_reference(setup.field, rays, hits, counters);
    setup.fast.trace(rays, hits, counters);
}

void trace_rays(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    trace::TraceCounters traced;
    chunk.hits.resize(chunk.rays.size());
    trace_rays(setup, chunk.rays, chunk.hits, traced);
    meter.book(Phase::rays, traced);
}

}  // namespace strata::integrate
