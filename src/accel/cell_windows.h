// Windows (src/trace/window.h) along the axes of the screen's finest cells, from where their beams stopped to where
// their rays should have met the surface.
//
// What a cell gets depends on its beam alone, never on its rays or on other cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/accel/cell_beam.h"
#include "src/trace/window.h"
#include "src/trace/window_jets.h"
#include "src/trace/window_plan.h"

namespace strata::accel {

// The windows of one cell, in the making.
struct WindowChain {
    const CellBeam* cell = nullptr;  // nullptr: it shall have none
    double s = 0.0;                  // axis coordinate of where the next window begins
    double slope = 0.0;              // of f along the axis there, about
    double clearance = 0.0;          // of f there, over the beam's width, about; 0: unknown
    double half = 0.0;               // half the length of the last window along the axis
    std::uint32_t first = 0;         // windows[first] is the first of the chain, windows[last] the last
    std::uint32_t last = 0;
    int length = 0;
    bool hits = false;  // all of the cell's rays hit within the windows
};

// Memory is reused from call to call.
struct WindowChains {
    std::vector<WindowChain> chains;
    std::vector<trace::Window> windows;
    std::vector<std::uint32_t> open;

    // nullptr: the chain has none.
    const trace::Window* first(std::size_t chain) const {
        return chains[chain].length == 0 ? nullptr : &windows[chains[chain].first];
    }
};

class CellWindows {
  public:
    explicit CellWindows(const trace::Field& field) : field_(field), plan_(field), jets_(field) {}

    // Puts windows for out.chains behind those that `out` holds.
    void build(WindowChains& out, trace::TraceCounters& counters) const;

  private:
    trace::WindowPlan::Size next_size(const WindowChain& chain) const;
    double half_length(const trace::Beam& beam, double begin, double ball) const;
    bool extend(WindowChain& chain, std::vector<trace::Window>& windows) const;
    bool goes_on(WindowChain& chain, const trace::Window& window) const;

    const trace::Field& field_;
    trace::WindowPlan plan_;
    trace::WindowJets jets_;
};

}  // namespace strata::accel
