#pragma once

#include <string_view>

#include "src/scene/scene.h"
#include "src/scene/scene_error.h"

namespace strata::scene {

// Lattice cells are counted in double from the surface's origin. Beyond this many within reach of the eye's rays,
// positions inside a cell would be rounded to quarters or worse: the noise would turn into steps. Shadow rays reach
// twice as far, to 2^51, where the fast tracer's cell arithmetic ends (trace/wide-inl.h).
inline constexpr double kMostCells = 0x1p50;

// Checks a whole scene, however it came about, before any ray is cast: every key against its range, then what no key
// can tell alone (an eye that looks at itself at any time; octaves too fine for double within reach at the time of the
// scene's frame). SceneError names key, value
// and what is allowed, after source_name and a colon unless that is empty.
void validate(const Scene& scene, std::string_view source_name = {});

// The farthest that a camera ray of the scene's frame gets from the surface's origin while the shutter is open, or more
// by what a curved way of the camera leaves open, in surface units.
double reach(const Scene& scene);

// The same of the points where its noise is evaluated, which drift.
double noise_reach(const Scene& scene);

}  // namespace strata::scene
