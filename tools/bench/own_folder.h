// Where this program lies.
#pragma once

#include <filesystem>

namespace strata::tools::bench {

// The folder of the running program's file: its companions are built into it.
std::filesystem::path own_folder();

}  // namespace strata::tools::bench
