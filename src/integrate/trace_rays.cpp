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

// The open rays, each in its cell's first zone.
void place_open_rays(const SurfaceChunk& chunk, OpenRays& open) {
    open.places.clear();
    std::uint32_t cell = 0;
    for (const std::uint32_t i : chunk.window_work.open) {
        while (i >= chunk.windowed[cell].last) ++cell;
        if (!chunk.zones[cell].empty()) open.places.push_back({i, cell, 0});
    }
}

// Follows the open rays through their zones, and lists those that leave them and have another.
void trace_zones(const SurfaceSetup& setup, SurfaceChunk& chunk, trace::TraceCounters& counters) {
    OpenRays& open = chunk.open;
    open.rays.clear();
    for (const OpenRays::Place& at : open.places) {
        const accel::Zone& zone = chunk.zones[at.cell][at.zone];
        trace::Ray& ray = open.rays.emplace_back(chunk.rays[at.ray]);
        ray.limit = std::min(ray.limit, zone.to);
        ray.start = std::max(ray.start, zone.from);
        ray.hint = zone.hint;
    }
    open.hits.resize(open.rays.size());
    setup.fast.trace(open.rays, open.hits, counters);
    open.next.clear();
    for (std::size_t k = 0; k < open.places.size(); ++k) {
        const OpenRays::Place& at = open.places[k];
        trace::Hit& hit = chunk.hits[at.ray];
        const std::uint32_t steps = hit.steps, evaluations = hit.noise_evaluations;
        hit = open.hits[k];
        hit.steps += steps;
        hit.noise_evaluations += evaluations;
        const bool has_more = at.zone + 1 < chunk.zones[at.cell].size();
        if (hit.state == trace::HitState::miss && has_more) open.next.push_back({at.ray, at.cell, at.zone + 1});
    }
    open.places.swap(open.next);
}

// By windows first; what these leave open, zone by zone.
void trace_cells(const SurfaceSetup& setup, SurfaceChunk& chunk, trace::TraceCounters& counters) {
    setup.windowed.trace(chunk.rays, chunk.windowed, chunk.hits, chunk.window_work, counters);
    place_open_rays(chunk, chunk.open);
    while (!chunk.open.places.empty()) trace_zones(setup, chunk, counters);
}

}  // namespace

void trace_rays(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    trace::TraceCounters traced;
    chunk.hits.resize(chunk.rays.size());
    if (setup.screen_beams) {
        trace_cells(setup, chunk, traced);
    } else {
        trace_rays(setup, chunk.rays, chunk.hits, traced);
    }
    meter.book(Phase::rays, traced);
}

}  // namespace strata::integrate
