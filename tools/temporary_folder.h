#pragma once

#include <filesystem>
#include <string>

namespace strata::tools {

// A folder of its own below TMPDIR, or /tmp, removed with all that is in it.
class TemporaryFolder {
  public:
    // "strata-NAME-" and six letters. Throws std::runtime_error that names the folder, TMPDIR and the reason.
    explicit TemporaryFolder(const std::string& name);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace strata::tools
