// Rays that share windows (window.h): brackets in closed form (bracket.h), then landings (landing.h). What these do not
// settle is left to the fast tracer, to go on from where it is known to be free.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/trace/bracket.h"
#include "src/trace/landing.h"

namespace strata::trace {

// Memory is reused from call to call.
struct WindowTracerWork {
    std::vector<Bracket> brackets;
    std::vector<std::uint32_t> landing, again;
    std::vector<std::uint32_t> open;  // the rays that were not settled, by index, in ascending order
};

class WindowTracer {
  public:
    explicit WindowTracer(const Field& field) : bracketer_(field), lander_(field) {}

    // groups: of all rays, in their order. Settled rays report their hits. The others, in work.open, get a `start`
    // behind which nothing is known, and their hits hold the steps and evaluations that they have cost.
    void trace(std::span<Ray> rays, std::span<const WindowedRays> groups, std::span<Hit> hits, WindowTracerWork& work,
               TraceCounters& counters) const;

  private:
    Bracketer bracketer_;
    Lander lander_;
};

}  // namespace strata::trace
