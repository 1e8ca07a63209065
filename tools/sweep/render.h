// The pictures of a sweep: those that are there already are kept, the others rendered.
#pragma once

#include <cstddef>
#include <filesystem>

#include "src/parallel/cancel.h"
#include "tools/cli/planned_files.h"
#include "tools/sweep/job.h"
#include "tools/sweep/ledger.h"

namespace strata::tools::sweep {

struct Outcome {
    std::size_t kept = 0, rendered = 0;
    std::size_t failed = 0;  // could not be written, as was told
    bool cancelled = false;
};

// Each picture is written when it is finished, and its cost with it. Prints what is kept and what is to be done. A
// picture that cannot be written is told and does not keep the others from being rendered; two in a row end the sweep.
Outcome render_sweep(cli::PlannedFiles& files, const Job& job, Ledger& ledger, const parallel::CancelToken& cancel);

}  // namespace strata::tools::sweep
