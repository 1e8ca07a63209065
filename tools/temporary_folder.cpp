#include "tools/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace strata::tools {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& name) {
    const char* const chosen = std::getenv("TMPDIR");
    const fs::path parent = chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
    // Other programs get the path, and may run elsewhere.
    std::string pattern = (fs::absolute(parent) / ("strata-" + name + "-XXXXXX")).string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error(fmt::format("cannot make a temporary folder in \"{}\": {}; TMPDIR chooses another",
                                             parent.string(), std::generic_category().message(errno)));
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace strata::tools
