// Lengths of time on the command line.
#pragma once

#include <string>

namespace strata::tools::cli {

// Seconds of "60s", "2m", "1.5h" or, without a unit, of "60": more than 0, at most 1000 hours. Throws UsageError.
double parse_duration(const char* option, const std::string& text);

}  // namespace strata::tools::cli
