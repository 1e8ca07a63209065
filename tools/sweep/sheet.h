// A sweep's contact sheet.
#pragma once

#include "src/image/canvas.h"
#include "src/image/metadata.h"
#include "tools/sweep/job.h"
#include "tools/sweep/results.h"

namespace strata::tools::sweep {

// Small pictures are magnified by replication; of large ones each pixel is the mean of n x n, in linear light.
image::Canvas draw_sheet(const Job& job, const Results& results);

image::Metadata sheet_metadata(const Job& job);

}  // namespace strata::tools::sweep
