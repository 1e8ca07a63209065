// What the tracers prepare from a relief: its parts' octaves with their constants in float.
#pragma once

#include <vector>

#include "noise/relief/relief.h"
#include "src/trace/trace_plan.h"

namespace strata::trace {

struct ReliefPlan {
    explicit ReliefPlan(const noise::Relief& of);

    const noise::Relief* relief;
    std::vector<std::vector<TraceOctave>> octaves;  // of each part
    std::vector<double> displacement;               // of each part: a bound of what its octaves can displace by
    float first_hint = 1.0f;                        // step length to begin with
};

}  // namespace strata::trace
