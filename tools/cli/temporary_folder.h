#pragma once

#include <deque>
#include <filesystem>
#include <string>

namespace strata::tools::cli {

// A folder of its own below TMPDIR, or /tmp, removed with all that is in it; by a signal that ends the program at once,
// with the files that file() named.
class TemporaryFolder {
  public:
    // "strata-NAME-" and six letters. Throws std::runtime_error that names the folder, TMPDIR and the reason.
    explicit TemporaryFolder(const std::string& name);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // The path of a file to be made in the folder.
    std::filesystem::path file(const std::string& name);

  private:
    std::filesystem::path path_;
    std::deque<std::filesystem::path> files_;  // their addresses are remembered
};

}  // namespace strata::tools::cli
