// Which frames an animation has.
#pragma once

#include <optional>
#include <string>

#include "src/scene/scene.h"

namespace strata::tools {

// Frames [first, last], both included.
struct FrameRange {
    int first = 0;
    int last = 0;

    int count() const { return last - first + 1; }
};

inline constexpr int kMostFrames = 100'000;  // of one animation

// "12" or "0-249". Throws UsageError.
FrameRange parse_frames(const std::string& text);

// The frames after which all motion of a scene begins again: the least whole number of them in which a spin makes whole
// turns, or the wheel's spokes move on by whole spokes. Nothing where it does not repeat within kMostFrames, goes along
// camera keys, drifts or does not move at all.
std::optional<int> loop_frames(const scene::Scene& scene);

// One loop from frame 0, or up to the last camera key. Throws UsageError, saying so, where there is neither.
FrameRange default_frames(const scene::Scene& scene);

}  // namespace strata::tools
