#include "src/render/image_function.h"

namespace strata::render {

PhaseCost& PhaseCost::operator+=(const PhaseCost& other) {
    seconds += other.seconds;
    noise_evaluations += other.noise_evaluations;
    steps += other.steps;
    return *this;
}

Counters& Counters::operator+=(const Counters& other) {
    rays += other.rays;
    shadow_rays += other.shadow_rays;
    hits += other.hits;
    unresolved_rays += other.unresolved_rays;
    noise_evaluations += other.noise_evaluations;
    executed_lanes += other.executed_lanes;
    steps += other.steps;
    for (std::size_t i = 0; i < kPhases; ++i) phases[i] += other.phases[i];
    return *this;
}

}  // namespace strata::render
