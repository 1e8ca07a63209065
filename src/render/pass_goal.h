// When a picture that grows by passes (progressive.h) is done, and what can be asked for.
//
// Memory, in bytes a pixel from the second pass on: the pass in work and the one before it 13 each, the sum 24. Where
// weights are random they take 8 in each of the three, and the error's moments 16 (kPassBytes, kWeightedPassBytes).
#pragma once

#include <cstdint>
#include <optional>

#include "src/estimate/estimator.h"
#include "src/film/film.h"

namespace strata::render {

inline constexpr int kMostPasses = 1'000'000;

inline constexpr int kPassBytes = 2 * 13 + 24;
inline constexpr int kWeightedPassBytes = kPassBytes + 3 * 8 + 16;

// Several goals: at the first that is reached.
struct PassGoal {
    int passes = 1;          // at most so many, in [1,kMostPasses]
    double target_rmse = 0;  // until ErrorEstimate::high is at most this, which takes four passes or more; 0: no target
    double time_limit_s = 0;  // no pass that is predicted to end later than this after the start; the first always is
                              // done; 0: no limit
};

// What is asked for.
struct PassRequest {
    std::optional<int> passes{};
    double target_rmse = 0, time_limit_s = 0;

    // Whether passes go on until something else ends them.
    bool is_open_ended() const { return target_rmse > 0 || time_limit_s > 0; }
};

// What errors call what is asked for: options of a command or fields of a struct have names of their own.
struct PassWords {
    const char *passes, *target_rmse, *time_limit;
    const char* smaller;  // what to ask for where memory is short: "a smaller window"
};

// Whether another pass of this estimator differs from the first. The grids of `none`, `super` and `uniform` do not:
// averaging would not lower their error.
bool passes_differ(scene::EstimatorKind kind);

// Bytes that each pixel takes while several passes are added up.
int bytes_a_pixel_of_passes(const estimate::Estimator& estimator);

// As many passes as are asked for, otherwise as many as it takes, one unless it is open-ended. Throws
// std::invalid_argument for more than one where passes do not differ.
PassGoal goal_of(const PassRequest& request, scene::EstimatorKind estimator, const PassWords& words);

// Throws std::invalid_argument where several passes do not fit into this memory. One pass is not held whole.
void check_memory(const PassGoal& goal, const estimate::EstimatorSettings& settings, const film::Rect& window,
                  std::uint64_t present_bytes, const PassWords& words);

}  // namespace strata::render
