// The files of an animation's frames.
#pragma once

#include <filesystem>
#include <string>

namespace strata::tools {

// Names of numbered files: "out/name.####.png"; each '#' is a digit at least. Without '#', "name.png" stands for
// "name.####.png".
class FramePattern {
  public:
    // Throws UsageError when '#' stand in several places or in a folder's name.
    explicit FramePattern(const std::filesystem::path& typed);

    std::filesystem::path path(int frame) const;

    // As ffmpeg's image2 takes it: "out/name.%04d.png", any '%' of the names doubled.
    std::string ffmpeg_pattern() const;

    // As shown to users: "out/name.####.png".
    std::string text() const;

  private:
    std::filesystem::path folder_;
    std::string before_, after_;
    int digits_ = 4;
};

}  // namespace strata::tools
