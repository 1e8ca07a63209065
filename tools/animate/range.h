// Which frames an animation has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace strata::tools::animate {

// Numbers of frames, ascending, each once; one at least.
class FrameList {
  public:
    FrameList() : numbers_{0} {}
    // In any order, repeated or not.
    explicit FrameList(std::vector<int> numbers);
    // Both included.
    static FrameList range(int first, int last, int step = 1);

    int first() const { return numbers_.front(); }
    int last() const { return numbers_.back(); }
    int count() const { return static_cast<int>(numbers_.size()); }
    auto begin() const { return numbers_.begin(); }
    auto end() const { return numbers_.end(); }

    // How far each frame is from the one before; of one frame 1. Nothing where they are unevenly spread.
    std::optional<int> step() const;

  private:
    std::vector<int> numbers_;
};

inline constexpr int kMostFrames = 100'000;  // of one animation

// "12", "0-249", "0-100x2" (every second) or several of these with commas between; origin is what the text was given
// to. Throws UsageError.
FrameList parse_frames(const std::string& text, const std::string& origin = "--frames");

// The frames after which all motion of a scene begins again: the least whole number of them in which a spin makes whole
// turns, or the wheel's spokes move on by whole spokes. Nothing where it does not repeat within kMostFrames, goes along
// camera keys, drifts or does not move at all.
std::optional<int> loop_frames(const scene::Scene& scene);

// One loop from frame 0, or up to the last camera key. Throws UsageError, saying so, where there is neither.
FrameList default_frames(const scene::Scene& scene);

}  // namespace strata::tools::animate
