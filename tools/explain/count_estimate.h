// What a whole render counts, as a pilot's blocks tell: a number, and an interval that holds the true one.
#pragma once

#include <functional>
#include <optional>

#include "tools/explain/pilot.h"

namespace strata::tools::explain {

struct CountEstimate {
    double value = 0.0;
    double low = 0.0, high = 0.0;  // the count is between them 99 times in 100
};

struct BlockCount {
    std::function<double(const integrate::Counters&)> of;  // what is counted, in a block
    // By how much a render may count more or less for the same samples, in other batches; may be empty.
    std::function<double(const integrate::Counters&)> doubt{};
    std::optional<double> most_a_ray{};  // if it is bounded
};

// Of a render of `rays` rays.
CountEstimate estimate_count(const PilotRun& pilot, double rays, const BlockCount& count);

}  // namespace strata::tools::explain
