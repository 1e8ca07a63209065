#pragma once

#include <cstdint>

namespace strata::render {

// What one sample took to evaluate: its ray, its normal and its shadow ray. Of a picture's samples they sum up to
// Counters::steps and Counters::noise_evaluations.
struct SampleCost {
    std::uint32_t steps = 0;
    std::uint32_t noise_evaluations = 0;
};

}  // namespace strata::render
