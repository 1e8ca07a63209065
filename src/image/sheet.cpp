#include "src/image/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "src/image/house_style.h"
#include "src/image/image_error.h"
#include "src/image/text.h"

namespace strata::image {
namespace {

constexpr int kLeastColumn = 104;     // "no antialiasing" on two lines, "RMSE 0.00123" on one
constexpr int kMostRowLabel = 150;    // wider ones are wrapped
constexpr int kLeastContent = 320;    // for title and caption
constexpr int kMostPixels = 1 << 28;  // 3 GB of floats

constexpr TextStyle kTitle{.size_px = house::kTitle_px, .weight = Weight::bold};
constexpr TextStyle kColumnLabel{.anchor = Anchor::centre};
constexpr TextStyle kRowLabel{.anchor = Anchor::right};
constexpr TextStyle kNote{.size_px = house::kNote_px, .colour = house::kMuted, .anchor = Anchor::centre};
constexpr TextStyle kStrongNote{.size_px = house::kNote_px, .anchor = Anchor::centre, .weight = Weight::bold};
constexpr TextStyle kCaption{.size_px = house::kNote_px, .colour = house::kMuted};

constexpr int kFrame = 1;  // around each picture

int height_of(const std::string& text, const TextStyle& style) {
    return text.empty() ? 0 : line_count(text) * line_height(style);
}

struct Layout {
    std::vector<int> column_width, row_height;  // of the pictures
    std::vector<int> note_height;               // a row
    std::vector<std::string> column_labels, row_labels;
    std::string title, caption;
    int row_label_width = 0;  // with the gap to the pictures
    int column_label_height = 0;
    int content_width = 0;
    int height = 0;
};

int sum(const std::vector<int>& values) { return std::accumulate(values.begin(), values.end(), 0); }

int gaps(std::size_t count) { return static_cast<int>(count - 1) * house::kGap; }

void check_shape(const Sheet& sheet) {
    const std::size_t rows = sheet.rows.size(), columns = rows == 0 ? 0 : sheet.rows.front().size();
    const bool is_grid =
        columns > 0 && std::ranges::all_of(sheet.rows, [&](const auto& row) { return row.size() == columns; });
    const auto fits = [](const std::vector<std::string>& labels, std::size_t n) {
        return labels.empty() || labels.size() == n;
    };
    if (is_grid && fits(sheet.column_labels, columns) && fits(sheet.row_labels, rows)) return;
    throw ImageError(fmt::format("{} rows and {} columns do not make a sheet with {} and {} labels", rows, columns,
                                 sheet.row_labels.size(), sheet.column_labels.size()));
}

void measure_panels(const Sheet& sheet, Layout& layout) {
    layout.column_width.assign(sheet.rows.front().size(), kLeastColumn);
    for (const std::vector<Panel>& row : sheet.rows) {
        int tallest = 0;
        for (std::size_t c = 0; c < row.size(); ++c) {
            layout.column_width[c] = std::max(layout.column_width[c], row[c].picture.width + 2 * kFrame);
            tallest = std::max(tallest, row[c].picture.height + 2 * kFrame);
        }
        layout.row_height.push_back(tallest);
    }
}

const TextStyle& note_style(const Panel& panel) { return panel.is_note_strong ? kStrongNote : kNote; }

void measure_texts(const Sheet& sheet, Layout& layout) {
    for (const std::vector<Panel>& row : sheet.rows) {
        int tallest = 0;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const TextStyle& style = note_style(row[c]);
            tallest = std::max(tallest, height_of(wrap(row[c].note, layout.column_width[c], style), style));
        }
        layout.note_height.push_back(tallest);
    }
    for (const std::string& label : sheet.row_labels) {
        layout.row_labels.push_back(wrap(label, kMostRowLabel, kRowLabel));
        layout.row_label_width = std::max(layout.row_label_width, text_width(layout.row_labels.back(), kRowLabel));
    }
    if (layout.row_label_width > 0) layout.row_label_width += house::kGap;
    for (std::size_t c = 0; c < sheet.column_labels.size(); ++c) {
        layout.column_labels.push_back(wrap(sheet.column_labels[c], layout.column_width[c], kColumnLabel));
        layout.column_label_height =
            std::max(layout.column_label_height, height_of(layout.column_labels.back(), kColumnLabel));
    }
}

Layout lay_out(const Sheet& sheet) {
    Layout layout;
    measure_panels(sheet, layout);
    measure_texts(sheet, layout);
    layout.content_width =
        std::max(kLeastContent, layout.row_label_width + sum(layout.column_width) + gaps(layout.column_width.size()));
    if (sheet.scale) layout.content_width = std::max(layout.content_width, sheet.scale->width);
    layout.title = wrap(sheet.title, layout.content_width, kTitle);
    layout.caption = wrap(sheet.caption, layout.content_width, kCaption);

    const auto with_gap = [](int height, int gap) { return height == 0 ? 0 : height + gap; };
    layout.height = 2 * house::kMargin + with_gap(height_of(layout.title, kTitle), house::kGap) +
                    with_gap(layout.column_label_height, house::kPad) + gaps(sheet.rows.size());
    for (std::size_t r = 0; r < sheet.rows.size(); ++r)
        layout.height += layout.row_height[r] + with_gap(layout.note_height[r], house::kPad);
    if (sheet.scale) layout.height += house::kGap + sheet.scale->height;
    layout.height += with_gap(height_of(layout.caption, kCaption), house::kGap);
    return layout;
}

void check_size(int width, int height) {
    if (width <= kLongestSide && height <= kLongestSide && width <= kMostPixels / height) return;
    throw ImageError(fmt::format("a sheet of {}x{} pixels is too large: allowed: {} a side, {} in all", width, height,
                                 kLongestSide, kMostPixels));
}

void draw_panel(Canvas& canvas, const Panel& panel, int left, int width, int top, int row_height) {
    const Canvas& picture = panel.picture;
    if (picture.width > 0) {
        const int x = left + (width - picture.width) / 2, y = top + kFrame;
        paste(canvas, picture, x, y);
        outline(canvas, {x, y, x + picture.width, y + picture.height}, house::kRule, kFrame);
    }
    const TextStyle& style = note_style(panel);
    if (!panel.note.empty())
        draw_text(canvas, left + width / 2, top + row_height + house::kPad, wrap(panel.note, width, style), style);
}

int draw_row(Canvas& canvas, const Sheet& sheet, const Layout& layout, std::size_t r, int top) {
    if (!layout.row_labels.empty()) {
        const std::string& label = layout.row_labels[r];
        draw_text(canvas, house::kMargin + layout.row_label_width - house::kGap,
                  top + (layout.row_height[r] - height_of(label, kRowLabel)) / 2, label, kRowLabel);
    }
    int left = house::kMargin + layout.row_label_width;
    for (std::size_t c = 0; c < sheet.rows[r].size(); ++c) {
        draw_panel(canvas, sheet.rows[r][c], left, layout.column_width[c], top, layout.row_height[r]);
        left += layout.column_width[c] + house::kGap;
    }
    return layout.row_height[r] + (layout.note_height[r] > 0 ? house::kPad + layout.note_height[r] : 0);
}

// Labels stand on the pictures: shorter ones start lower.
int draw_column_labels(Canvas& canvas, const Layout& layout, int top) {
    if (layout.column_label_height == 0) return 0;
    int left = house::kMargin + layout.row_label_width;
    for (std::size_t c = 0; c < layout.column_labels.size(); ++c) {
        const std::string& label = layout.column_labels[c];
        draw_text(canvas, left + layout.column_width[c] / 2,
                  top + layout.column_label_height - height_of(label, kColumnLabel), label, kColumnLabel);
        left += layout.column_width[c] + house::kGap;
    }
    return layout.column_label_height + house::kPad;
}

}  // namespace

Canvas compose(const Sheet& sheet) {
    check_shape(sheet);
    const Layout layout = lay_out(sheet);
    const int width = 2 * house::kMargin + layout.content_width;
    check_size(width, layout.height);
    Canvas canvas = make_canvas(width, layout.height, house::kPaper);

    int y = house::kMargin;
    if (!layout.title.empty()) y += draw_text(canvas, house::kMargin, y, layout.title, kTitle) + house::kGap;
    y += draw_column_labels(canvas, layout, y);
    for (std::size_t r = 0; r < sheet.rows.size(); ++r) y += draw_row(canvas, sheet, layout, r, y) + house::kGap;
    if (sheet.scale) {
        paste(canvas, *sheet.scale, house::kMargin + layout.row_label_width, y);
        y += sheet.scale->height + house::kGap;
    }
    if (!layout.caption.empty()) draw_text(canvas, house::kMargin, y, layout.caption, kCaption);
    return canvas;
}

}  // namespace strata::image
