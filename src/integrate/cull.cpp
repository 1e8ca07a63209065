#include "src/integrate/cull.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "src/integrate/phase_meter.h"

namespace strata::integrate {

void follow_beams(const SurfaceSetup& setup, const SampleBatch& samples, CulledBatch& batch, Counters& counters) {
    PhaseMeter meter(counters);
    trace::TraceCounters traced, windows;
    batch.first_cell = batch.last_cell = batch.first = batch.last = 0;
    if (setup.screen_beams) {
        setup.screen_beams->trace(samples.u, samples.v, samples.t, batch.beamed, traced, windows);
    } else {
        std::vector<std::uint32_t>& order = batch.beamed.samples.order;
        order.resize(samples.u.size());
        std::iota(order.begin(), order.end(), 0u);
        batch.beamed.cells.clear();
        if (!order.empty()) batch.beamed.cells.push_back({.last = static_cast<std::uint32_t>(order.size())});
    }
    meter.book(Phase::windows, windows);  // their time is the beams'
    meter.book(Phase::beams, traced);
}

// Whole cells, as many as fit; one that is too large by itself is taken in several chunks.
bool next_chunk(CulledBatch& batch, SurfaceChunk& chunk) {
    const std::span<const accel::BeamedCell> cells = batch.beamed.cells;
    if (batch.last_cell == 0 || batch.last == cells[batch.last_cell - 1].last) {
        if (batch.last_cell == cells.size()) return false;
        batch.first_cell = batch.last_cell++;
        const std::size_t first = cells[batch.first_cell].first;
        while (batch.last_cell < cells.size() && cells[batch.last_cell].last - first <= kChunk) ++batch.last_cell;
    }
    batch.first = batch.last;
    batch.last = std::min<std::size_t>(batch.first + kChunk, cells[batch.last_cell - 1].last);
    chunk.order = std::span(batch.beamed.samples.order).subspan(batch.first, batch.last - batch.first);
    return true;
}

void cull_rays(const SurfaceSetup& setup, CulledBatch& batch, SurfaceChunk& chunk, Counters& counters) {
    if (!setup.screen_beams) return;
    PhaseMeter meter(counters);
    const auto cells = std::span<const accel::BeamedCell>(batch.beamed.cells)
                           .subspan(batch.first_cell, batch.last_cell - batch.first_cell);
    chunk.windowed.clear();
    chunk.zones.clear();
    for (const accel::BeamedCell& cell : cells) {
        // A cell larger than a chunk is in several.
        const std::size_t first = std::max<std::size_t>(cell.first, batch.first) - batch.first;
        const std::size_t last = std::min<std::size_t>(cell.last, batch.last) - batch.first;
        const std::span<const accel::Zone> zones = batch.beamed.zones_of(cell);
        for (std::size_t i = first; i < last; ++i) {
            trace::Ray& ray = chunk.rays[i];
            ray.start = zones.empty() ? std::numeric_limits<double>::infinity() : zones.front().from;
            ray.hint = zones.empty() ? 0.0f : zones.front().hint;
        }
        chunk.windowed.push_back({first, std::max(first, last), batch.beamed.first_window(cell)});
        chunk.zones.push_back(zones);
    }
    meter.book(Phase::shading);
}

}  // namespace strata::integrate
