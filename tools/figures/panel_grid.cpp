#include "tools/figures/panel_grid.h"

#include <algorithm>

#include "src/image/house_style.h"
#include "src/image/text.h"

namespace strata::tools::figures {

namespace {

using namespace image;

constexpr TextStyle kTitleStyle{.size_px = house::kTitle_px, .weight = Weight::bold};
constexpr TextStyle kLabelStyle{.size_px = house::kLabel_px};
constexpr TextStyle kNoteStyle{.size_px = house::kNote_px, .colour = house::kMuted};

struct Layout {
    int panel_width = 0, panel_height = 0, label_height = 0;

    int column(int i) const { return house::kMargin + i * (panel_width + house::kGap); }
    int row_height() const { return label_height + house::kPad + panel_height + house::kGap; }
};

Layout layout_of(const std::vector<LabelledPanel>& panels) {
    Layout layout{panels.front().canvas.width, panels.front().canvas.height, 0};
    for (const LabelledPanel& panel : panels) {
        if (panel.label.empty()) continue;
        const std::string text = wrap(panel.label, layout.panel_width, kLabelStyle);
        layout.label_height = std::max(layout.label_height, line_count(text) * line_height(kLabelStyle));
    }
    return layout;
}

void draw_panel(Canvas& page, const LabelledPanel& panel, const Layout& layout, int x, int y) {
    const std::string text = wrap(panel.label, layout.panel_width, kLabelStyle);
    const int empty = layout.label_height - line_count(text) * line_height(kLabelStyle);
    draw_text(page, x, y + empty, text, kLabelStyle);
    const int top = y + layout.label_height + house::kPad;
    paste(page, panel.canvas, x, top);
    outline(page, {x, top, x + panel.canvas.width, top + panel.canvas.height}, house::kRule);
}

}  // namespace

Canvas panel_grid(const std::string& title, const std::string& note, int columns,
                  const std::vector<LabelledPanel>& panels) {
    const Layout layout = layout_of(panels);
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    const int width = layout.column(columns) - house::kGap + house::kMargin;
    const int inside = width - 2 * house::kMargin;
    const std::string title_text = wrap(title, inside, kTitleStyle), note_text = wrap(note, inside, kNoteStyle);
    const int title_height = line_count(title_text) * line_height(kTitleStyle) + house::kGap;
    const int note_height = line_count(note_text) * line_height(kNoteStyle);

    const int height = 2 * house::kMargin + title_height + rows * layout.row_height() + note_height;
    Canvas page = make_canvas(width, height, house::kPaper);
    draw_text(page, house::kMargin, house::kMargin, title_text, kTitleStyle);
    int top = house::kMargin + title_height;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const int place = static_cast<int>(i);
        draw_panel(page, panels[i], layout, layout.column(place % columns),
                   top + place / columns * layout.row_height());
    }
    top += rows * layout.row_height();
    draw_text(page, house::kMargin, top, note_text, kNoteStyle);
    return page;
}

}  // namespace strata::tools::figures
