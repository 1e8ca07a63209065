#include "src/integrate/trace_rays.h"

#include <algorithm>

#include "src/integrate/phase_meter.h"
#include "src/trace/reference_tracer.h"

namespace strata::integrate {

void trace_rays(const SurfaceSetup& setup, std::span<const trace::Ray> rays, std::span<trace::Hit> hits,
                trace::TraceCounters& counters) {
    if (setup.tracer == Tracer::reference) return trace::trace_reference(setup.field, rays, hits, counters);
    setup.fast.trace(rays, hits, counters);
}

namespace {

// Rays whose windows settle them, then the others.
void trace_windowed(const SurfaceSetup& setup, SurfaceChunk& chunk, trace::TraceCounters& counters) {
    setup.windowed.trace(chunk.rays, chunk.windowed, chunk.hits, chunk.window_work, counters);
    const std::span<const std::uint32_t> open = chunk.window_work.open;
    chunk.open_rays.clear();
    for (const std::uint32_t i : open) chunk.open_rays.push_back(chunk.rays[i]);
    chunk.open_hits.resize(open.size());
    setup.fast.trace(chunk.open_rays, chunk.open_hits, counters);
    for (std::size_t k = 0; k < open.size(); ++k) {
        trace::Hit& hit = chunk.hits[open[k]];
        const std::uint32_t steps = hit.steps, evaluations = hit.noise_evaluations;
        hit = chunk.open_hits[k];
        hit.steps += steps;
        hit.noise_evaluations += evaluations;
    }
}

}  // namespace

void trace_rays(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    trace::TraceCounters traced;
    chunk.hits.resize(chunk.rays.size());
    const auto has_window = [](const trace::WindowedRays& group) { return group.window != nullptr; };
    if (std::ranges::any_of(chunk.windowed, has_window)) {
        trace_windowed(setup, chunk, traced);
    } else {
        trace_rays(setup, chunk.rays, chunk.hits, traced);
    }
    meter.book(Phase::rays, traced);
}

}  // namespace strata::integrate
