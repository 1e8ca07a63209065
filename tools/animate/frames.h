// The files of an animation's frames.
#pragma once

#include <filesystem>
#include <string>

namespace strata::tools::animate {

// Names of numbered files: "out/name.####.png"; each '#' is a digit at least, the last run of them if there are
// several. Without '#', "name.png" stands for "name.####.png".
class FramePattern {
  public:
    explicit FramePattern(const std::filesystem::path& typed);

    std::filesystem::path path(int frame) const;

    // As shown to users: "out/name.####.png".
    std::string text() const;

  private:
    std::filesystem::path folder_;
    std::string before_, after_;
    int digits_ = 4;
};

}  // namespace strata::tools::animate
