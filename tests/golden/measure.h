// What is pinned of a scene: the bits of its pixels and the work that they took.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "src/image/picture.h"
#include "src/integrate/image_function.h"
#include "tests/golden/scenes.h"

namespace strata::golden {

// In the order in which they are written down.
struct Record {
    std::vector<std::pair<std::string, std::string>> digests;   // "pixels"; "steps_aov" and so on where asked for
    std::vector<std::pair<std::string, std::uint64_t>> counts;  // "total.rays"; "shadows.steps": of a phase
};

struct Measurement {
    Record record;
    image::Picture picture;
};

// How the picture is cut into work. Some counts depend on it, the pixels do not.
struct Cut {
    int threads;
    int tile;
};
inline constexpr Cut kPinnedCut{1, 16};
inline constexpr Cut kOtherCut{3, 7};

// The line of a phase's counts: "sun_beams".
std::string phase_key(integrate::Phase phase);

std::string pixels_digest(const image::Picture& picture);

// Renders on the SIMD target in use, the way the program does.
Measurement measure(const GoldenScene& golden, const Cut& cut);

}  // namespace strata::golden
