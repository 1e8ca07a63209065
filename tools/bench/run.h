// Measures a plan: rounds, each of every case once, whose pieces take turns, so that whatever disturbs the machine
// disturbs all alike.
#pragma once

#include <memory>
#include <optional>

#include "src/render/cancel.h"
#include "src/render/progress.h"
#include "tools/bench/results.h"

namespace strata::tools::bench {

// Cancelled: a round that was not finished is left out; without a whole one there are no measurements.
Results run(const Plan& plan, int rounds, const render::ProgressCallback& on_progress,
            const render::CancelToken& cancel);

}  // namespace strata::tools::bench
