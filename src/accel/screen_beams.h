// Up to where the rays through each part of the screen are free of the surface, by a descent (cell_tree.h) through the
// cells of screen_cells.h.
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
#include "src/trace/beam_tracer.h"

namespace strata::accel {

// The samples of one cell whose beam was followed to its end.
struct BeamedCell {
    std::uint32_t first = 0;  // samples.order[first, last)
    std::uint32_t last = 0;
    bool misses = false;       // its rays meet nothing
    double start = 0.0;        // its rays are free up to this distance
    float hint = 0.0f;         // step length to go on with
    std::int32_t window = -1;  // the first of its windows, of windows.windows; below 0 where there is none
};

// What a descent must remember of a cell.
struct ScreenCellFrame {
    CellBeam::Margins margins;
    std::int32_t chain = -1;  // of its windows, of windows.chains; below 0 where there is none
};

// Memory is reused from call to call.
struct BeamedSamples {
    SortedCodes samples;
    std::vector<BeamedCell> cells;  // in the samples' order
    WindowChains windows;           // of all cells

    CellTree<ScreenCellFrame> tree;
    std::vector<CellBeam> chained;  // the cells of windows.chains

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
    class Descent;

    CellBeams around_;
    trace::BeamTracer tracer_;
    CellWindows windows_;
    ScreenHierarchy hierarchy_;
};

}  // namespace strata::accel
