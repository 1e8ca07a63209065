// The progress of several renders, one after the other, as that of one.
#pragma once

#include <chrono>
#include <cstdint>

#include "src/film/film.h"
#include "src/parallel/progress.h"
#include "src/scene/scene.h"

namespace strata::tools::job {

// Rays that a render will cast, nearly: what its share of the work is taken to be.
double expected_rays(const scene::Scene& scene, const film::Rect& window);

class BatchProgress {
  public:
    // total: the sum of the weights of all renders to come.
    BatchProgress(double total, parallel::ProgressCallback show) : total_(total), show_(std::move(show)) {}

    // The callback of the next render; it must end before the one after it begins.
    parallel::ProgressCallback next(double weight);

  private:
    void advance(const parallel::Progress& progress);

    double total_;
    parallel::ProgressCallback show_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double done_ = 0, weight_ = 0;
    std::uint64_t rays_ = 0, current_rays_ = 0;
};

}  // namespace strata::tools::job
