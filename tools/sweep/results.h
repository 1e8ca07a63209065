// How far each picture of a finished sweep is from its reference, and how far that is to be trusted.
#pragma once

#include <optional>
#include <vector>

#include "src/image/compare.h"
#include "tools/cli/planned_files.h"
#include "tools/sweep/job.h"

namespace strata::tools::sweep {

// An error below this many times the reference's own is partly the reference's.
inline constexpr double kTrustFactor = 3;

struct Results {
    std::vector<std::optional<image::Comparison>> cells;  // as in the job; none without a reference
    std::vector<double> reference_errors;                 // as in the job: RMSE of the mean, from its halves

    bool is_near_reference(const Job& job, std::size_t cell) const;
};

// Reads the pictures back and writes the means of the references' halves. The difference of two independent halves has
// twice the variance of one of them, their mean half of it: its error is RMSE(a, b) / 2.
Results evaluate_sweep(cli::PlannedFiles& files, const Job& job);

}  // namespace strata::tools::sweep
