#include "tools/bench/own_folder.h"

namespace strata::tools::bench {

std::filesystem::path own_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace strata::tools::bench
