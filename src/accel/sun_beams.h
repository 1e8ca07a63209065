// Shadow rays are parallel: beams come down from the sun, around square cells of the plane across its direction, and
// each shadow ray needs following only up to where its cell's beam stopped.
//
// The cells belong to a fixed hierarchy in the surface's coordinates, which a descent (cell_tree.h) goes through; a
// ray's cell depends on that ray alone.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "src/accel/cell_tree.h"
#include "src/trace/beam_tracer.h"

namespace strata::accel {

// Memory is reused from call to call.
struct SunlitCells {
    struct Top {
        std::int64_t a, b;
    };
    std::vector<Top> tops;             // the coarsest cells met
    std::vector<double> a, b;          // of each ray's finest cell, counted from the middle of its coarsest
    std::vector<std::uint64_t> ranks;  // of each ray's coarsest cell in `tops`
    std::vector<int> levels;           // of the cell that each ray asks for
    SortedCodes rays;
    CellTree<double> tree;
};

class SunBeams {
  public:
    // to_sun: of unit length, in the surface's coordinates. noise_shift: the field's, of all rays.
    SunBeams(const trace::Field& field, const glm::dvec3& to_sun, const glm::dvec3& noise_shift);

    // Whether all rays towards the sun leave the surface for good.
    bool usable() const { return usable_; }

    // Shortens the rays' limits to where they are free. spacing: of each ray, how far its neighbours are from it across
    // the sun's direction, about.
    void shorten(std::span<trace::Ray> rays, std::span<const double> spacing, SunlitCells& cells,
                 trace::TraceCounters& counters) const;

  private:
    class Descent;

    int level_of(double spacing) const;
    void sort(std::span<const trace::Ray> rays, std::span<const double> spacing, SunlitCells& cells) const;
    trace::Beam beam(const SunlitCells& cells, std::uint64_t code, int level, double* top_height) const;

    trace::BeamTracer tracer_;
    glm::dvec3 to_sun_, a_, b_;  // an orthonormal frame
    glm::dvec3 noise_shift_;
    double top_side_ = 1.0;  // of the coarsest cells
    double amplitude_ = 0.0;
    double bounding_ball_ = 0.0;  // 0: there is none, and all lies under a plane with this `up`
    glm::dvec3 up_{0.0};
    double rise_ = 0.0;  // of the way to the sun over that plane
    bool usable_ = false;
};

}  // namespace strata::accel
