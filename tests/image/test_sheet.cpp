#include "src/image/sheet.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "src/image/house_style.h"
#include "src/image/image_error.h"

using namespace strata::image;

namespace {

Panel panel(int width, int height, const Colour& colour, std::string note = "") {
    return {make_canvas(width, height, colour), std::move(note), false};
}

// The box of all pixels of exactly this colour, and how many there are.
struct Found {
    Box box;
    int count = 0;
};

Found find(const Canvas& canvas, const Colour& colour) {
    Found found{{canvas.width, canvas.height, 0, 0}, 0};
    for (int y = 0; y < canvas.height; ++y)
        for (int x = 0; x < canvas.width; ++x) {
            const float* rgb = &canvas.rgb[3 * (static_cast<std::size_t>(y) * canvas.width + x)];
            if (Colour{rgb[0], rgb[1], rgb[2]} != colour) continue;
            Box& b = found.box;
            b = {std::min(b.x0, x), std::min(b.y0, y), std::max(b.x1, x + 1), std::max(b.y1, y + 1)};
            ++found.count;
        }
    return found;
}

constexpr Colour kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1};

}  // namespace

TEST_CASE("every picture is there whole, in its row and column, and all margins are paper") {
    for (const bool labelled : {false, true}) {
        Sheet sheet;
        sheet.rows = {{panel(40, 30, kRed, "a note"), panel(200, 60, kGreen)}, {panel(10, 90, kBlue), {}}};
        if (labelled) {
            sheet.title = "A title that is far too long for the little room that these small pictures leave to it";
            sheet.caption = sheet.title + "\n" + sheet.title;
            sheet.column_labels = {"a label which has to be wrapped", "N = 2"};
            sheet.row_labels = {"m = 1", "another label which has to be wrapped"};
            sheet.scale = make_canvas(300, 20, {0.5f, 0.5f, 0.5f});
        }
        const Canvas canvas = compose(sheet);
        const Found red = find(canvas, kRed), green = find(canvas, kGreen), blue = find(canvas, kBlue);
        CHECK(red.count == 40 * 30);
        CHECK(green.count == 200 * 60);
        CHECK(blue.count == 10 * 90);
        CHECK(red.box.x1 < green.box.x0);
        CHECK(green.box.y1 < blue.box.y0);
        CHECK(red.box.y0 == green.box.y0);
        CHECK(red.box.x0 + red.box.x1 == blue.box.x0 + blue.box.x1);
        if (labelled) CHECK(find(canvas, {0.5f, 0.5f, 0.5f}).count >= 300 * 20);

        Canvas inner = canvas;
        fill(inner,
             {house::kMargin - 2, house::kMargin - 2, canvas.width - house::kMargin + 2,
              canvas.height - house::kMargin + 2},
             house::kPaper);
        CHECK(find(inner, house::kPaper).count == canvas.width * canvas.height);
    }
}

TEST_CASE("equal sheets are equal canvases") {
    const Sheet sheet{.title = "T",
                      .column_labels = {"x"},
                      .row_labels = {},
                      .rows = {{panel(8, 8, kRed, "n")}},
                      .scale = {},
                      .caption = "c"};
    CHECK(compose(sheet).rgb == compose(sheet).rgb);
}

TEST_CASE("sheets without panels, with ragged rows, wrong labels or beyond all bounds are refused") {
    CHECK_THROWS_AS(compose({}), ImageError);
    Sheet ragged;
    ragged.rows = {{panel(2, 2, kRed)}, {panel(2, 2, kRed), panel(2, 2, kRed)}};
    CHECK_THROWS_AS(compose(ragged), ImageError);
    Sheet labels;
    labels.rows = {{panel(2, 2, kRed)}};
    labels.column_labels = {"a", "b"};
    CHECK_THROWS_AS(compose(labels), ImageError);
    Sheet wide;
    wide.rows = {{panel(40000, 1, kRed), panel(40000, 1, kRed)}};
    CHECK_THROWS_WITH_AS(compose(wide), doctest::Contains("65500"), ImageError);
}
