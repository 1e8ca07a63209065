// The progress of several renders, one after the other, as that of one.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

#include "src/parallel/progress.h"

namespace strata::tools::job {

class BatchProgress {
  public:
    // total: the sum of the weights of all renders to come.
    BatchProgress(double total, parallel::ProgressCallback show) : total_(total), show_(std::move(show)) {}

    // More is to come than was said.
    void expect(double weight) { total_ += weight; }

    // The callback of the next render; it must end before the one after it begins.
    parallel::ProgressCallback next(double weight);

  private:
    void advance(const parallel::Progress& progress);

    double total_;
    parallel::ProgressCallback show_;
    std::optional<std::chrono::steady_clock::time_point> start_;  // of the first render
    double done_ = 0, weight_ = 0;
    std::uint64_t rays_ = 0, current_rays_ = 0;
};

}  // namespace strata::tools::job
