// Tells renders of different settings apart, for files that hold counts and times of one.
#pragma once

#include <string>
#include <string_view>

#include "tools/job/picture_job.h"

namespace strata::tools::job {

// 16 hexadecimal digits: 64-bit FNV-1a.
std::string mark_of(std::string_view text);

// A mark that differs, but for chance, when scene, window or tracer of a picture do. Title and what
// colours the picture, exposure to tone curve, are left out: they cost nothing.
std::string settings_mark(const PictureJob& job);

}  // namespace strata::tools::job
