// Peak memory of whole renders, each by the program itself in a process of its own.
#pragma once

#include <vector>

#include "src/parallel/cancel.h"
#include "tools/bench/results.h"

namespace strata::tools::bench {

// hyperterrain, N = 1, to EXR, in a temporary folder: 1920x1080, and 16384x16384 unless `quick`. A render that fails is
// a row that says why.
std::vector<MemoryResult> measure_memory(bool quick, const parallel::CancelToken& cancel);

}  // namespace strata::tools::bench
