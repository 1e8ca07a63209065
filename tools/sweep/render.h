// The pictures of a sweep: those that are there already are kept, the others rendered.
#pragma once

#include <cstddef>
#include <filesystem>

#include "src/render/cancel.h"
#include "tools/sweep/job.h"
#include "tools/sweep/ledger.h"

namespace strata::tools {

struct SweepOutcome {
    std::size_t kept = 0, rendered = 0;
    std::size_t unresolved_rays = 0;  // of the pictures rendered now
    bool cancelled = false;
};

// Each picture is written when it is finished, and its cost with it. Prints what is kept and what is to be done.
SweepOutcome render_sweep(const SweepJob& job, SweepLedger& ledger, const render::CancelToken& cancel);

}  // namespace strata::tools
