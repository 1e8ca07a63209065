// Where the frames of a film alone are kept until it is encoded.
#pragma once

#include <filesystem>

namespace strata::tools::animate {

// FILM.frames beside the film, made if need be: what an interrupted run left there is gone on from. While another run
// has it - it locks a file in it - or something else has the name, FILM-2.frames and so on. Gone with this object if
// there is nothing in it.
class FramesFolder {
  public:
    // Throws ImageError when no folder can be had.
    explicit FramesFolder(const std::filesystem::path& film);
    ~FramesFolder();
    FramesFolder(const FramesFolder&) = delete;
    FramesFolder& operator=(const FramesFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    bool take(const std::filesystem::path& folder);

    std::filesystem::path path_, lock_file_;
    int lock_ = -1;
};

}  // namespace strata::tools::animate
