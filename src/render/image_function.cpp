#include "src/render/image_function.h"

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

}  // namespace strata::render
