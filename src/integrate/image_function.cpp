#include "src/integrate/image_function.h"

namespace strata::integrate {

const char* name_of(Phase phase) {
    switch (phase) {
        case Phase::beams:
            return "beams";
        case Phase::windows:
            return "windows";
        case Phase::rays:
            return "rays";
        case Phase::normals:
            return "normals";
        case Phase::sun_beams:
            return "sun beams";
        case Phase::shadows:
            return "shadows";
        case Phase::sky_rays:
            return "sky rays";
        case Phase::bounces:
            return "bounces";
        case Phase::shading:
            return "shading";
    }
    return "";
}

PhaseCost& PhaseCost::operator+=(const PhaseCost& other) {
    seconds += other.seconds;
    noise_evaluations += other.noise_evaluations;
    steps += other.steps;
    left_out += other.left_out;
    return *this;
}

Counters& Counters::operator+=(const Counters& other) {
    rays += other.rays;
    shadow_rays += other.shadow_rays;
    sky_rays += other.sky_rays;
    hits += other.hits;
    unresolved_rays += other.unresolved_rays;
    noise_evaluations += other.noise_evaluations;
    executed_lanes += other.executed_lanes;
    steps += other.steps;
    for (std::size_t i = 0; i < kPhases; ++i) phases[i] += other.phases[i];
    return *this;
}

}  // namespace strata::integrate
