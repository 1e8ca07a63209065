// The picture of a strip whose parts are all there.
#pragma once

#include "src/image/canvas.h"
#include "src/image/metadata.h"
#include "tools/strip/job.h"

namespace strata::tools::strip {

image::Canvas draw_strip(const Job& job);

// How the strip was made: settings, crop, zoom, reference. Nothing that differs between equal strips.
image::Metadata strip_metadata(const Job& job);

}  // namespace strata::tools::strip
