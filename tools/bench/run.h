// Measures a plan: rounds, each of every case once, whose pieces take turns, so that whatever disturbs the machine
// disturbs all alike.
#pragma once

#include <memory>
#include <optional>

#include "src/parallel/cancel.h"
#include "src/parallel/progress.h"
#include "tools/bench/results.h"

namespace strata::tools::bench {

// Cancelled: a round that was not finished is left out; without a whole one there are no measurements.
Results run(const Plan& plan, int rounds, const parallel::ProgressCallback& on_progress,
            const parallel::CancelToken& cancel);

}  // namespace strata::tools::bench
