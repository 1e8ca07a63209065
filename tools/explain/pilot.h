// A few of a render's samples, evaluated to learn what the rest will cost.
#pragma once

#include <cstdint>

#include "src/render/estimator.h"
#include "src/render/film.h"
#include "src/render/image_function.h"

namespace strata::tools {

struct PilotRun {
    render::Counters counters;
    double cpu_seconds = 0.0;  // of evaluating the image function
};

// About `rays` samples (all, if there are no more) of those that pixels of the window take, or cells, where samples are
// shared: short runs of neighbours, one in each of equal stretches of the window's rows, so that they cover it evenly
// and travel in packets like a render's. Pixels give at most kPilotN^2 samples, for there to be many pixels.
inline constexpr int kPilotN = 4;
PilotRun run_pilot(const render::ImageFunction& image, const render::EstimatorSettings& settings,
                   const render::Window& owners, std::uint64_t rays);

// CPU time of placing a sample and of adding it up, in seconds: what a constant picture costs under the estimator.
double estimator_seconds_a_ray(const render::EstimatorSettings& settings);

}  // namespace strata::tools
