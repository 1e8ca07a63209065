// What is said of times that were measured several times.
#pragma once

#include <vector>

namespace strata::tools::report {

// Median and quartiles, by linear interpolation between the sorted values; zeros without values.
struct Spread {
    double median = 0, low_quartile = 0, high_quartile = 0;
};
Spread spread_of(std::vector<double> values);

}  // namespace strata::tools::report
