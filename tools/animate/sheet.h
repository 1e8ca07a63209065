// A frame of pictures side by side.
#pragma once

#include <vector>

#include "src/image/canvas.h"
#include "tools/job/column_settings.h"

namespace strata::tools::animate {

// One picture a column, under its label. The size depends on the labels and the pictures' sizes alone.
image::Canvas side_by_side(const std::vector<job::ColumnSettings>& columns, std::vector<image::Canvas> pictures);

}  // namespace strata::tools::animate
