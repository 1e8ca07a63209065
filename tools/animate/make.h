// Frames that are not there yet, rendered and written; and the films that are made of them.
#pragma once

#include "src/parallel/cancel.h"
#include "tools/animate/job.h"

namespace strata::tools::animate {

// Makes all of an animation. Each file fails alone and is told; two frames in a row of which none could be written end
// it. What was stopped by the token goes on from there when it is made again. Returns the command's exit code. Throws
// UsageError for a frame that is there and is another one.
int make_animation(Job job, const parallel::CancelToken& cancel);

}  // namespace strata::tools::animate
