#include "src/trace/relief_plan.h"

namespace strata::trace {

ReliefPlan::ReliefPlan(const noise::Relief& of) : relief(&of) {
    double coarsest = 0.0;
    for (const noise::ReliefPart& part : of.parts()) {
        std::vector<TraceOctave>& prepared = octaves.emplace_back();
        double most = 0.0;
        for (const noise::Octave& octave : part.octaves) {
            prepared.push_back(prepare_octave(octave));
            most += octave.amplitude;
            if (coarsest == 0.0 || octave.frequency < coarsest) coarsest = octave.frequency;
        }
        displacement.push_back(most);
    }
    if (coarsest > 0.0) first_hint = static_cast<float>(0.15 / coarsest);
}

}  // namespace strata::trace
