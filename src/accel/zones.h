// Stretches of a bundle of rays in which these may meet the surface. A beam that touches something need not be the end:
// what lies behind a crest is often free again, and whoever follows the rays one by one should look at the crest alone.
//
// A beam goes from `from` to its first touch. From there it jumps ahead, about which nothing is claimed, and begins
// anew; where it gets on, the stretch between touch and new beginning is a zone, and so forth up to `to`. Beams around
// narrower bundles then look at the zones only.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "src/accel/cell_beam.h"
#include "src/trace/beam_tracer.h"

namespace strata::accel {

// Distances along rays: outside of its zones a bundle is free. The rest tells how to go on at `from`.
struct Zone {
    double from = 0.0;
    double to = std::numeric_limits<double>::infinity();
    double s = 0.0;      // axis coordinate at which the beam ended
    float slope = 0.0f;  // of f along the axis there, about
    float hint = 0.0f;   // step length to go on with
};

// In ascending order. Further ones are merged with the last.
struct ZoneList {
    static constexpr std::size_t kMost = 8;
    std::array<Zone, kMost> zones;
    std::uint32_t count = 0;

    std::span<const Zone> all() const { return {zones.data(), count}; }

    // In any order; zones do not overlap.
    void put(const Zone& zone);

    // Makes one zone of those from that distance on.
    void merge_from(double distance);
};

// A bundle on its way. Without a beam around it (a limit of 0) its zones stay as they are.
struct ZonedBundle {
    CellBeam cell;
    ZoneList zones;  // in which it may meet something; those that come out are parts of those that go in
};

// Memory is reused from call to call.
class ZoneTracer {
  public:
    // jumps: after every touch at most; with 0 a touch is a zone up to the end of the one that went in.
    void follow(const trace::BeamTracer& tracer, std::span<ZonedBundle> bundles, int jumps,
                trace::TraceCounters& counters);

  private:
    // A zone that went in, as far as it is done.
    struct Walk {
        std::uint32_t bundle = 0;
        std::uint32_t left = 0;  // jumps
        double end = 0.0;        // axis coordinate
        double from = 0.0;       // distances
        double to = 0.0;
        double at = 0.0;    // axis coordinate of where the next beam begins
        double jump = 0.0;  // in radii
        bool touched = false;
        Zone zone;  // the one being looked at, from its touch on
    };
    void begin(std::span<ZonedBundle> bundles, int jumps);
    bool goes_on(Walk& walk, const trace::BeamEnd& end, const CellBeam& cell, ZoneList& out, int jumps);

    std::vector<Walk> walks_;
    std::vector<trace::Beam> beams_;
    std::vector<trace::BeamEnd> ends_;
    std::vector<double> solid_;  // of each bundle: its zone from this distance on hides all that follow
};

}  // namespace strata::accel
