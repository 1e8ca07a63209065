#include "tools/bench/phases.h"

#include <algorithm>
#include <string>

namespace strata::tools::bench {

namespace {

// A phase without a name here is a warning of the compiler, and told by its number.
std::string name_of(render::Phase phase) {
    switch (phase) {
        case render::Phase::beams:
            return "beams";
        case render::Phase::rays:
            return "rays";
        case render::Phase::normals:
            return "normals";
        case render::Phase::sun_beams:
            return "sun beams";
        case render::Phase::shadows:
            return "shadows";
        case render::Phase::shading:
            return "shading";
    }
    return "phase " + std::to_string(static_cast<int>(phase));
}

}  // namespace

std::vector<Phase> phases_of(const render::RenderResult& result) {
    std::vector<Phase> phases;
    double rest_s = result.seconds * result.threads;  // by the clock, as the phases' own
    for (std::size_t i = 0; i < render::kPhases; ++i) {
        const render::PhaseCost& cost = result.counters.phases[i];
        phases.push_back({name_of(static_cast<render::Phase>(i)), cost.seconds, cost.steps, cost.noise_evaluations});
        rest_s -= cost.seconds;
    }
    phases.push_back({"samples and film", std::max(rest_s, 0.0), 0, 0});
    return phases;
}

void add_phases(std::vector<Phase>& sum, const std::vector<Phase>& part) {
    for (const Phase& phase : part) {
        const auto found = std::ranges::find(sum, phase.name, &Phase::name);
        if (found == sum.end()) {
            sum.push_back(phase);
            continue;
        }
        found->seconds += phase.seconds;
        found->steps += phase.steps;
        found->noise_evaluations += phase.noise_evaluations;
    }
}

}  // namespace strata::tools::bench
