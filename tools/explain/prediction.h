// What a render will cost, from a pilot of a few of its rays; and what one did cost, as `strata render --stats` told.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/integrate/surface_image.h"
#include "src/scene/scene.h"
#include "tools/explain/count_estimate.h"
#include "tools/job/aov.h"

namespace strata::tools::explain {

using Count = std::uint64_t integrate::Counters::*;

// Of all counts but the rays, which are known exactly, and those that nobody plans for.
constexpr bool is_predicted(Count count) {
    return count != &integrate::Counters::rays && count != &integrate::Counters::unresolved_rays;
}

// A value for each row of integrate::kCounters.
template <class Value>
class OfCounts {
  public:
    Value& operator[](Count count) { return values_[index_of(count)]; }
    const Value& operator[](Count count) const { return values_[index_of(count)]; }

  private:
    static std::size_t index_of(Count count) {
        const auto found = std::ranges::find(integrate::kCounters, count, &integrate::CounterRow::member);
        return static_cast<std::size_t>(found - std::begin(integrate::kCounters));
    }

    std::array<Value, std::size(integrate::kCounters)> values_{};
};

// Nothing where it is not known. Predicted counts are rounded expectations; rays are exact.
struct Costs {
    std::uint64_t rays = 0;
    OfCounts<std::optional<double>> counts;
    std::optional<double> cpu_seconds, seconds;
    std::optional<double> peak_memory_bytes;
};

struct Pilot {
    std::uint64_t rays = 0;  // of the scene's picture; shadow rays come on top, as in a render
    double cpu_seconds = 0.0;
};

// Where counts lie, from a pilot; a point where they are known.
using CountsBetween = OfCounts<std::optional<CountEstimate>>;

struct Prediction {
    Costs costs;
    CountsBetween between;
    std::optional<Pilot> pilot;
    int threads = 1;
};

// A pilot takes this fraction of the rays, but at least kLeastPilotRays, or all if there are no more than twice as
// many, and at most kMostPilotRays, or kMostReferenceRays of the reference tracer's.
inline constexpr double kPilotFraction = 0.01;
inline constexpr std::uint64_t kLeastPilotRays = 1u << 16;
inline constexpr std::uint64_t kMostPilotRays = 1u << 18;
inline constexpr std::uint64_t kMostReferenceRays = 1u << 14;

std::uint64_t pilot_rays(std::uint64_t rays, integrate::Tracer tracer);

// Rays of one pass over the window of a valid scene's frame, exactly.
std::uint64_t count_rays(const scene::Scene& scene, const film::Rect& window);

struct PredictionSettings {
    integrate::Tracer tracer = integrate::Tracer::fast;
    int threads = 0;  // 0: as many as the machine has
    int passes = 1;   // costs are those of one, but memory
    integrate::ChannelSet aovs{};
    bool with_pilot = true;
};

// Of rendering that window. Counts are the same in every run, times are not.
Prediction predict(const scene::Scene& scene, const film::Rect& window, const PredictionSettings& settings);

}  // namespace strata::tools::explain
