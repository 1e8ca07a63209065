// A few of a render's samples, evaluated to learn what the rest will cost.
#pragma once

#include <cstdint>
#include <vector>

#include "src/estimate/estimator.h"
#include "src/film/film.h"
#include "src/integrate/image_function.h"

namespace strata::tools::explain {

struct PilotRun {
    integrate::Counters counters;               // of all blocks
    std::vector<integrate::Counters> by_block;  // row by row
    int columns = 1;                            // blocks a row
    double cpu_seconds = 0.0;                   // of evaluating the image function
    // How many cells of the screen a ray of a render's batch touches, over how many one of these blocks does.
    double shared_correction = 1.0;
};

// About `rays` samples (all, if there are no more; at least a pixel's) of those that pixels of the window take, or
// cells, where samples are shared: small blocks of neighbours, one in each of equal parts of the window, which share
// what a render's samples share.
PilotRun run_pilot(const integrate::ImageFunction& image, const estimate::EstimatorSettings& settings,
                   const film::Rect& owners, std::uint64_t rays);

// CPU time of placing a sample and of adding it up, in seconds: what a constant picture costs under the estimator.
double estimator_seconds_a_ray(const estimate::EstimatorSettings& settings);

}  // namespace strata::tools::explain
