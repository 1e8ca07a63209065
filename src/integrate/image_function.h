// The one abstraction: a picture is radiance as a function of screen position and time. Estimators (estimator.h) turn
// any such function into pixels and know nothing of what lies behind it.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <glm/glm.hpp>
#include <iterator>
#include <span>
#include <utility>

#include "src/integrate/channels.h"
#include "src/sample/dimensions.h"
#include "src/trace/ray.h"

namespace strata::integrate {

// Where the work of a ray-cast surface is done.
enum class Phase { beams, windows, rays, normals, sun_beams, shadows, sky_rays, bounces, water, shading };
inline constexpr std::size_t kPhases = 10;

// "sun beams".
const char* name_of(Phase phase);

struct PhaseCost {
    double seconds = 0.0;  // of one thread's time; depends on the machine, unlike all else here
    std::uint64_t noise_evaluations = 0;
    std::uint64_t steps = 0;
    trace::LeftOut left_out{};

    PhaseCost& operator+=(const PhaseCost& other);
};

// Work done, exact and independent of threads. What beams and windows do, that samples of a batch share, depends on the
// batches and so on tiles and crop; as do executed_lanes, which count SIMD lanes that idle, too.
struct Counters {
    std::uint64_t rays = 0;  // image-function samples evaluated; counted by the renderer, all else by image functions
    std::uint64_t shadow_rays = 0;
    std::uint64_t sky_rays = 0;
    std::uint64_t water_rays = 0;  // mirrored and refracted
    std::uint64_t hits = 0;
    std::uint64_t unresolved_rays = 0;
    std::uint64_t noise_evaluations = 0;
    std::uint64_t executed_lanes = 0;
    std::uint64_t steps = 0;
    std::array<PhaseCost, kPhases> phases;

    Counters& operator+=(const Counters& other);
};

// Every count of them by its name, which sums, comparisons, files and tables go over.
struct CounterRow {
    const char* name;
    std::uint64_t Counters::*member;
};
inline constexpr CounterRow kCounters[] = {{"rays", &Counters::rays},
                                           {"shadow_rays", &Counters::shadow_rays},
                                           {"sky_rays", &Counters::sky_rays},
                                           {"water_rays", &Counters::water_rays},
                                           {"hits", &Counters::hits},
                                           {"unresolved_rays", &Counters::unresolved_rays},
                                           {"noise_evaluations", &Counters::noise_evaluations},
                                           {"executed_lanes", &Counters::executed_lanes},
                                           {"steps", &Counters::steps}};
static_assert(sizeof(Counters) == std::size(kCounters) * sizeof(std::uint64_t) + sizeof(Counters::phases),
              "a row for each count");

// Whether all of these counts are equal.
bool same_counts(const Counters& a, const Counters& b);

// Positions in pixels in the whole frame (u right, v down, pixel (0,0) has its centre at (0.5, 0.5)); t in seconds.
// The three spans have equal length.
struct SampleBatch {
    std::span<const double> u;
    std::span<const double> v;
    std::span<const double> t;
    sample::SampleOwners owners{};  // which pixels or cells they belong to, if any

    // Where a sample has further random dimensions from: of samples that belong to nothing, its place and time.
    sample::SampleId id(std::size_t i) const {
        return owners.keys.empty() ? sample::id_of_place(u[i], v[i], t[i]) : owners.id(i);
    }
};

// Where the results of a batch go, each of its samples in the batch's order.
struct SampleOut {
    SampleOut() = default;

    // Radiance alone.
    SampleOut(std::span<glm::vec3> sample_radiance) : radiance(sample_radiance) {}
    template <class Radiance>
    requires std::convertible_to<Radiance&, std::span<glm::vec3>> SampleOut(Radiance& sample_radiance)
        : radiance(sample_radiance) {}

    SampleOut(std::span<glm::vec3> sample_radiance, const ChannelSet& asked, std::span<float> channel_values)
        : radiance(sample_radiance), channels(&asked), values(channel_values) {}

    bool has_channels() const { return channels != nullptr && !channels->empty(); }

    std::span<glm::vec3> radiance;
    const ChannelSet* channels = nullptr;  // asked for; none: radiance alone
    std::span<float> values;               // channels->values() a sample
};

class ImageFunction {
  public:
    virtual ~ImageFunction() = default;

    // Linear radiance of each sample, and the channels asked for. A sample's result depends on that sample alone -
    // place, time and id - never on the rest of the batch. Thread-safe. counters belong to the caller.
    virtual void evaluate(const SampleBatch& samples, const SampleOut& out, Counters& counters) const = 0;

    // How many samples to hand over at once: enough to amortise the call, few enough to stop soon when cancelled.
    virtual std::size_t batch_samples() const { return 2048; }
};

}  // namespace strata::integrate
