// Numbered frames to a film, by ffmpeg.
#pragma once

#include <filesystem>

#include "tools/animate/frames.h"
#include "tools/animate/range.h"

namespace strata::tools {

// By extension: .mp4 (H.264), .webm (VP9) or .gif (256 colours of its own, plays for ever).
bool is_film(const std::filesystem::path& path);

// Encodes PNG frames. Colours are tagged as BT.709, sides padded to even numbers for video; equal frames make equal
// files. The film appears whole or not at all. Throws ProcessError.
void encode_film(const std::filesystem::path& film, const FramePattern& frames, const FrameRange& range, double fps);

}  // namespace strata::tools
