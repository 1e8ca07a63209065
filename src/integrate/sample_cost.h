#pragma once

#include <cstdint>

namespace strata::integrate {

// What one sample took to evaluate: its ray, its normal and its shadow ray. Beams and windows, which many samples
// share, are in none: of a picture's samples these sum up to Counters::steps and noise_evaluations less those of their
// phases.
struct SampleCost {
    std::uint32_t steps = 0;
    std::uint32_t noise_evaluations = 0;
};

}  // namespace strata::integrate
