// Pictures in rows and columns with labels, notes, a title and a caption, in the house style.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/image/canvas.h"

namespace strata::image {

struct Panel {
    Canvas picture;               // 0x0: an empty place
    std::string note;             // below the picture
    bool is_note_strong = false;  // in ink and bold, to stand out from the other notes
};

// Texts are UTF-8, may have line feeds and are wrapped to the place they have; empty ones take none.
struct Sheet {
    std::string title;
    std::vector<std::string> column_labels;  // empty, or one a column
    std::vector<std::string> row_labels;     // empty, or one a row
    std::vector<std::vector<Panel>> rows;    // of equal length
    std::optional<Canvas> scale;             // below the rows
    std::string caption;                     // at the bottom
};

// Columns are as wide as their widest picture, but wide enough for a few words. Throws ImageError when there is no
// panel, labels and panels differ in number, or a side would pass kLongestSide.
Canvas compose(const Sheet& sheet);

}  // namespace strata::image
