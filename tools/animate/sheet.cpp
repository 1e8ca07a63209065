#include "tools/animate/sheet.h"

#include <utility>

#include "src/image/sheet.h"

namespace strata::tools::animate {

image::Canvas side_by_side(const std::vector<job::ColumnSettings>& columns, std::vector<image::Canvas> pictures) {
    image::Sheet sheet;
    sheet.rows.resize(1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        sheet.column_labels.push_back(columns[i].label);
        sheet.rows.front().push_back({std::move(pictures[i]), "", false});
    }
    return image::compose(sheet);
}

}  // namespace strata::tools::animate
