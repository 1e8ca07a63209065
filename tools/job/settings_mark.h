// Tells renders of different settings apart, for files that hold counts and times of one.
#pragma once

#include <string>

#include "src/film/film.h"
#include "src/scene/scene.h"

namespace strata::tools::job {

// 16 hexadecimal digits that differ, but for chance, when scene, window or tracer do. Title and what colours the
// picture, exposure to tone curve, are left out: they cost nothing. 64-bit FNV-1a of the printed scene.
std::string settings_mark(const scene::Scene& scene, const film::Rect& window, const std::string& tracer);

}  // namespace strata::tools::job
