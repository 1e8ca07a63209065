#include "src/trace/window_tracer.h"

#include <algorithm>

namespace strata::trace {

namespace {

// A bracket that so many landings do not settle grazes, or float cannot tell where f vanishes. Speed only.
constexpr int kMostLandings = 4;

}  // namespace

void WindowTracer::trace(std::span<Ray> rays, std::span<const WindowedRays> groups, std::span<Hit> hits,
                         WindowTracerWork& work, TraceCounters& counters) const {
    work.brackets.resize(rays.size());
    work.landing.clear();
    work.open.clear();
    const auto leave_open = [&](std::uint32_t i) {
        rays[i].start = std::max(rays[i].start, work.brackets[i].outside);
        work.open.push_back(i);
    };
    for (const WindowedRays& group : groups) {
        std::fill(hits.begin() + static_cast<std::ptrdiff_t>(group.first),
                  hits.begin() + static_cast<std::ptrdiff_t>(group.last), Hit{});
        if (group.window == nullptr) {
            for (std::size_t i = group.first; i < group.last; ++i) {
                if (rays[i].start < rays[i].limit) work.open.push_back(static_cast<std::uint32_t>(i));
            }
            continue;
        }
        bracketer_.bracket(rays, group, work.brackets);
        for (std::size_t k = group.first; k < group.last; ++k) {
            const auto i = static_cast<std::uint32_t>(k);
            if (work.brackets[i].state == BracketState::bracket) work.landing.push_back(i);
            if (work.brackets[i].state == BracketState::open) leave_open(i);
        }
    }
    for (int round = 0; round < kMostLandings && !work.landing.empty(); ++round) {
        work.again.clear();
        lander_.land(rays, work.landing, work.brackets, hits, work.again, counters);
        work.landing.swap(work.again);
    }
    for (const std::uint32_t i : work.landing) leave_open(i);
}

}  // namespace strata::trace
