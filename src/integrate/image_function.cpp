#include "src/integrate/image_function.h"

#include <algorithm>

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
        case Phase::water:
            return "water";
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
    for (const auto& [name, member] : kCounters) this->*member += other.*member;
    for (std::size_t i = 0; i < kPhases; ++i) phases[i] += other.phases[i];
    return *this;
}

bool same_counts(const Counters& a, const Counters& b) {
    return std::ranges::all_of(kCounters, [&](const CounterRow& row) { return a.*row.member == b.*row.member; });
}

}  // namespace strata::integrate
