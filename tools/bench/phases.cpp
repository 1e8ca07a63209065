#include "tools/bench/phases.h"

#include <algorithm>

namespace strata::tools::bench {

std::vector<Phase> phases_of(const render::RenderResult& result) {
    std::vector<Phase> phases;
    double rest_s = result.seconds * result.threads;  // by the clock, as the phases' own
    for (std::size_t i = 0; i < integrate::kPhases; ++i) {
        const integrate::PhaseCost& cost = result.counters.phases[i];
        phases.push_back(
            {integrate::name_of(static_cast<integrate::Phase>(i)), cost.seconds, cost.steps, cost.noise_evaluations});
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
