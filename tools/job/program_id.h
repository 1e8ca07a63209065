// Which build of the program this is.
#pragma once

#include <string>

namespace strata::tools::job {

// The version and, where the linker wrote one, the build's id: "0.1.0, build 9f2c...". Two builds of one version may
// differ in their last bits.
std::string program_id();

}  // namespace strata::tools::job
