// How fast a film plays its frames.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/scene/rate.h"
#include "tools/animate/range.h"

namespace strata::tools::animate {

struct FilmTiming {
    std::vector<int> frames;  // those that the film has
    scene::Rate rate = 25.0;  // at which they come
    double seconds = 0;       // how long it plays
    // Of a GIF, whose frames last whole hundredths of a second: that of the last one.
    std::optional<int> last_delay_cs{};
};

// Evenly spread frames play as fast as they were taken. A GIF leaves out frames where they come faster than players
// show them, fifty a second, and its delays add up to the time of the whole, to a hundredth of a second.
FilmTiming film_timing(const std::filesystem::path& film, const FrameList& frames, const scene::Rate& rate);

// Throws UsageError for a film that could not play in time: of unevenly spread frames, or at a rate that its kind of
// file cannot hold.
void check_timing(const std::filesystem::path& film, const FrameList& frames, const scene::Rate& rate);

// "5 frames, 0.2 s", and which were left out.
std::string described(const FilmTiming& timing, const FrameList& frames);

}  // namespace strata::tools::animate
