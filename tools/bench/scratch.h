// A temporary folder, gone with the object; and where this program lies.
#pragma once

#include <filesystem>

namespace strata::tools::bench {

class Scratch {
  public:
    Scratch();  // throws std::filesystem::filesystem_error
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

// The folder of the running program's file: its companions are built into it.
std::filesystem::path own_folder();

}  // namespace strata::tools::bench
