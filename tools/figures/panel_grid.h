// Pictures side by side, each under its label: how figures 4 to 8 are laid out.
#pragma once

#include <string>
#include <vector>

#include "src/image/canvas.h"

namespace strata::tools::figures {

struct LabelledPanel {
    image::Canvas canvas;
    std::string label;  // may have several lines
};

// Rows of `columns` panels, all of the first one's size, under a title and over a note, which is wrapped.
image::Canvas panel_grid(const std::string& title, const std::string& note, int columns,
                         const std::vector<LabelledPanel>& panels);

}  // namespace strata::tools::figures
