#include "tools/bench/scratch.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace strata::tools::bench {

namespace fs = std::filesystem;

Scratch::Scratch() {
    std::string name = (fs::temp_directory_path() / "strata-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw fs::filesystem_error("cannot make a temporary folder", name,
                                   std::error_code(errno, std::generic_category()));
    }
    path_ = name;
}

Scratch::~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

fs::path own_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace strata::tools::bench
