// What a render did cost, as `strata render --stats` recorded it.
#pragma once

#include <filesystem>
#include <string>

#include "tools/explain/prediction.h"

namespace strata::tools::explain {

struct Recorded {
    Costs costs;  // of one pass, where the render took several: shares of the whole
    std::uint64_t passes = 1;
    int threads = 0;
    std::string simd_target;
};

// Throws UsageError if the file cannot be read, is no such record, is of other settings than `mark` (settings_mark.h),
// or of a render that was interrupted: its rays are no multiple of `rays`.
Recorded read_recorded(const std::filesystem::path& path, const std::string& mark, std::uint64_t rays);

}  // namespace strata::tools::explain
