#include "src/render/image_function.h"

#include <algorithm>

namespace strata::render {

Counters& Counters::operator+=(const Counters& other) {
    rays += other.rays;
    shadow_rays += other.shadow_rays;
    hits += other.hits;
    unresolved_rays += other.unresolved_rays;
    noise_evaluations += other.noise_evaluations;
    executed_lanes += other.executed_lanes;
    steps += other.steps;
    return *this;
}

void ImageFunction::evaluate_with_costs(const SampleBatch& samples, std::span<glm::vec3> radiance,
                                        std::span<SampleCost> costs, Counters& counters) const {
    std::fill(costs.begin(), costs.end(), SampleCost{});
    evaluate(samples, radiance, counters);
}

}  // namespace strata::render
