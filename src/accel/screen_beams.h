// Where the rays through each part of the screen may meet the surface: a descent through the cells of screen_cells.h,
// with beams around them (zones.h) from the coarsest to the finest, and windows where the beams met something.
//
// What a sample gets depends on its own cell alone, never on the other samples.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/accel/cell_beam.h"
#include "src/accel/cell_tree.h"
#include "src/accel/cell_windows.h"
#include "src/accel/screen_cells.h"
#include "src/accel/zones.h"
#include "src/trace/beam_tracer.h"

namespace strata::accel {

// The samples of one cell that is done.
struct BeamedCell {
    std::uint32_t first = 0;  // samples.order[first, last)
    std::uint32_t last = 0;
    std::uint32_t first_zone = 0;  // zones[first_zone, last_zone), outside of which its rays are free
    std::uint32_t last_zone = 0;
    std::int32_t window = -1;  // the first of its windows, of windows.windows; below 0 where there is none
};

// A cell that holds samples, on the way down.
struct ScreenNode {
    std::uint32_t first, last;  // its samples have the sorted codes [first, last)
    ZoneList zones;
};

// Memory is reused from call to call.
struct BeamedSamples {
    SortedCodes samples;
    std::vector<BeamedCell> cells;  // in the samples' order
    std::vector<Zone> zones;        // of all cells
    WindowChains windows;

    // The cells of a level that are at work; of children, the bundles, and which chain of windows each has, or below 0.
    std::vector<ScreenNode> nodes, children;
    std::vector<ZonedBundle> bundles;
    std::vector<std::int32_t> chains;
    ZoneTracer zone_tracer;

    std::span<const Zone> zones_of(const BeamedCell& cell) const {
        return std::span(zones).subspan(cell.first_zone, cell.last_zone - cell.first_zone);
    }

    // nullptr: the cell has none.
    const trace::Window* first_window(const BeamedCell& cell) const {
        return cell.window < 0 ? nullptr : &windows.windows[static_cast<std::size_t>(cell.window)];
    }
};

class ScreenBeams {
  public:
    ScreenBeams(const scene::Scene& scene, const scene::CameraPath& path, const trace::Placement& placement,
                const trace::Field& field);

    // Of samples at (u, v), px, and times t; the three spans have equal length. Windows are counted by themselves.
    void trace(std::span<const double> u, std::span<const double> v, std::span<const double> t, BeamedSamples& out,
               trace::TraceCounters& counters, trace::TraceCounters& window_counters) const;

  private:
    void split(int level, BeamedSamples& out) const;
    void open_windows(int level, BeamedSamples& out, trace::TraceCounters& window_counters) const;
    void keep(int level, BeamedSamples& out) const;

    CellBeams around_;
    trace::BeamTracer tracer_;
    CellWindows windows_;
    ScreenHierarchy hierarchy_;
};

}  // namespace strata::accel
