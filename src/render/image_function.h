// The one abstraction: a picture is radiance as a function of screen position and time. Estimators (estimator.h) turn
// any such function into pixels and know nothing of what lies behind it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "src/render/sample_cost.h"

namespace strata::render {

// Work done, exact and independent of threads and tiles; but for executed_lanes, which also counts SIMD lanes that idle
// and so depends on how rays came to share packets.
struct Counters {
    std::uint64_t rays = 0;  // image-function samples evaluated; counted by the renderer, all else by image functions
    std::uint64_t shadow_rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t unresolved_rays = 0;
    std::uint64_t noise_evaluations = 0;
    std::uint64_t executed_lanes = 0;
    std::uint64_t steps = 0;

    Counters& operator+=(const Counters& other);
};

// Positions in pixels in the whole frame (u right, v down, pixel (0,0) has its centre at (0.5, 0.5)); t in seconds.
// The three spans have equal length.
struct SampleBatch {
    std::span<const double> u;
    std::span<const double> v;
    std::span<const double> t;
};

class ImageFunction {
  public:
    virtual ~ImageFunction() = default;

    // Linear radiance of each sample. A sample's result depends on that sample alone, never on the rest of the batch.
    // Thread-safe. counters belong to the caller.
    virtual void evaluate(const SampleBatch& samples, std::span<glm::vec3> radiance, Counters& counters) const = 0;

    // The same radiance, and what each sample cost: nothing, unless a function traces.
    virtual void evaluate_with_costs(const SampleBatch& samples, std::span<glm::vec3> radiance,
                                     std::span<SampleCost> costs, Counters& counters) const;
};

}  // namespace strata::render
