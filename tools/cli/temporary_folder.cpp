#include "tools/cli/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "src/image/file_paths.h"
#include "src/image/scratch_files.h"

namespace strata::tools::cli {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& name) {
    const fs::path parent = image::temporary_place();
    // Other programs get the path, and may run elsewhere.
    std::string pattern = (fs::absolute(parent) / ("strata-" + name + "-XXXXXX")).string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error(fmt::format("cannot make a temporary folder in \"{}\": {}; TMPDIR chooses another",
                                             parent.string(), std::generic_category().message(errno)));
    }
    path_ = pattern;
    image::remember_scratch_file(path_.c_str());
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    for (const fs::path& file : files_) image::forget_scratch_file(file.c_str());
    image::forget_scratch_file(path_.c_str());
}

fs::path TemporaryFolder::file(const std::string& name) {
    image::remember_scratch_file(files_.emplace_back(path_ / name).c_str());
    return files_.back();
}

}  // namespace strata::tools::cli
