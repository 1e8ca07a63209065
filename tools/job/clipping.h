// What is said of radiance that a half could not hold.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tools/cli/standard_output.h"

namespace strata::tools::job {

// For image::WriteOptions::warn.
inline void warn_of_clipping(const std::string& what) {
    cli::print_error(fmt::format("warning: {}; --format float keeps it", what));
}

}  // namespace strata::tools::job
