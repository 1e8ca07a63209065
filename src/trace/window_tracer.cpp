#include "src/trace/window_tracer.h"

#include <algorithm>

namespace strata::trace {

namespace {

// A bracket that so many landings do not settle grazes, or float cannot tell where f vanishes. Speed only.
constexpr int kMostLandings = 4;

}  // namespace

void WindowTracer::trace(std::span<Ray> rays, std::span<const WindowedRays> groups, std::span<Hit> hits,
                         WindowTracerWork& work, TraceCounters& counters) const {
    work.brackets.assign(rays.size(), {});
    work.landing.clear();
    for (const WindowedRays& group : groups) {
        if (group.window == nullptr) continue;
        bracketer_.bracket(rays, group, work.brackets);
        for (std::size_t i = group.first; i < group.last; ++i) {
            if (work.brackets[i].state == BracketState::bracket) work.landing.push_back(static_cast<std::uint32_t>(i));
        }
    }
    std::ranges::fill(hits, Hit{});
    for (int round = 0; round < kMostLandings && !work.landing.empty(); ++round) {
        work.again.clear();
        lander_.land(rays, work.landing, work.brackets, hits, work.again, counters);
        work.landing.swap(work.again);
    }
    for (const std::uint32_t i : work.landing) work.brackets[i].state = BracketState::open;
    work.open.clear();
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
        if (work.brackets[i].state != BracketState::open) continue;
        rays[i].start = std::max(rays[i].start, work.brackets[i].outside);
        if (rays[i].start < rays[i].limit) work.open.push_back(i);
    }
}

}  // namespace strata::trace
