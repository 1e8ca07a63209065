// Where the time of a render went, phase by phase: the one place that reads the renderer's own account of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/render/render.h"

namespace strata::tools::bench {

struct Phase {
    std::string name;
    double seconds = 0;
    std::uint64_t steps = 0;
    std::uint64_t noise_evaluations = 0;
};

// In the order of work; the last is what no phase of the image function accounts for: placing samples, adding them up.
std::vector<Phase> phases_of(const render::RenderResult& result);

// Adds `part` up into `sum`, by name.
void add_phases(std::vector<Phase>& sum, const std::vector<Phase>& part);

}  // namespace strata::tools::bench
