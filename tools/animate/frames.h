// The files of an animation's frames, and whether they are there already.
#pragma once

#include <filesystem>
#include <string>

#include "src/image/metadata.h"

namespace strata::tools {

// Names of numbered files: "out/name.####.png"; each '#' is a digit at least. Without '#', "name.png" stands for
// "name.####.png".
class FramePattern {
  public:
    // Throws UsageError when '#' stand in several places or in a folder's name.
    explicit FramePattern(const std::filesystem::path& typed);

    std::filesystem::path path(int frame) const;

    // As shown to users: "out/name.####.png".
    std::string text() const;

  private:
    std::filesystem::path folder_;
    std::string before_, after_;
    int digits_ = 4;
};

enum class FrameState { missing, whole, other };

struct FoundFrame {
    FrameState state = FrameState::missing;
    std::string why;  // it is another: what differs or is wrong with it
};

// Whether the file is a frame of this size that can be read to its end and says the same of itself.
FoundFrame find_frame(const std::filesystem::path& path, const image::Metadata& expected, int width, int height);

}  // namespace strata::tools
