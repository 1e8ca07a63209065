// Numbered frames to a film, by ffmpeg.
#pragma once

#include <filesystem>

#include "src/image/placing.h"
#include "tools/animate/frames.h"
#include "tools/animate/timing.h"

namespace strata::tools::animate {

// By extension: .mp4 (H.264), .webm (VP9) or .gif (256 colours of its own, plays for ever).
bool is_film(const std::filesystem::path& path);

// Encodes PNG frames of width x height. Colours are tagged as BT.709, odd sides of video repeat their last row or
// column; equal frames make equal files. The film is written to `file`, which is not put in place. Throws ProcessError.
void encode_film(const std::filesystem::path& film, const image::ScratchFile& file, const FramePattern& frames,
                 const FilmTiming& timing, int width, int height);

}  // namespace strata::tools::animate
