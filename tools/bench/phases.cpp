#include "tools/bench/phases.h"

#include <algorithm>

namespace strata::tools::bench {

// Counters of this renderer hold totals alone.
std::vector<Phase> phases_of(const render::RenderResult&) { return {}; }

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
