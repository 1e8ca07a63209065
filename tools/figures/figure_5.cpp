// Figure 5: the whole surface, and where on it figures 6 and 7 look.
#include "src/image/canvas.h"
#include "src/image/house_style.h"
#include "src/image/text.h"
#include "tools/figures/figure.h"
#include "tools/figures/surface_areas.h"

namespace strata::tools::figures {

namespace figure_5 {
namespace {

constexpr image::Colour kFrame{1.0f, 0.72f, 0.0f};  // on dark and on bright ground

Plan plan(Size size) {
    Plan result;
    result.number = 5;
    result.title = "The procedural surface";
    result.caption =
        "An implicit surface, |x| = radius + a sum of 12 octaves of gradient noise, ray cast with N² = 100 samples a "
        "pixel through the cubic B-spline, m = 4. The outlined areas are those of figures 6 and 7.";
    result.chosen = {"the surface and the view: the paper's are lost", "both areas"};
    result.shown = {
        {"figure-5.png",
         "A rugged planet, green and brown with white peaks, lit from the left before a dark sky. Two small squares "
         "are outlined: 6 on white peaks near the top, 7 on the ragged rim at the upper right."},
        {"figure-5-plain.png", "The same planet without outlines."}};
    const scene::Scene scene = surface_scene(size);
    result.parts = {{"figure-5-surface.exr", scene, {0, 0, scene.film.width, scene.film.height}, 0.4}};
    const auto corners = [](const film::Rect& w) { return std::vector<int>{w.x0, w.y0, w.x1, w.y1}; };
    result.parameters = {{"area_of_figure_6", corners(detail_of_figure_6(size))},
                         {"area_of_figure_7", corners(detail_of_figure_7(size))}};
    return result;
}

void mark(image::Canvas& canvas, const std::vector<int>& corners, const char* label) {
    const image::Box box{corners[0], corners[1], corners[2], corners[3]};
    image::outline(canvas, box, image::house::kInk, 3);
    image::outline(canvas, box, kFrame, 2);
    const image::TextStyle style{.size_px = image::house::kTitle_px, .colour = kFrame, .weight = image::Weight::bold};
    const int width = image::text_width(label, style) + 2 * image::house::kPad;
    const image::Box plate{box.x1 + 3, box.y0 - 2, box.x1 + 3 + width, box.y0 - 2 + image::line_height(style)};
    image::fill(canvas, plate, image::house::kInk);
    image::draw_text(canvas, plate.x0 + image::house::kPad, plate.y0, label, style);
}

void draw(const Plan& plan, Pictures pictures, const std::filesystem::path& folder) {
    image::Canvas canvas = image::to_canvas(pictures[0], image::colour_out(plan.parts[0].scene.film));
    image::write_canvas(folder / plan.shown[1].file, canvas);
    mark(canvas, plan.parameters.at("area_of_figure_6"), "6");
    mark(canvas, plan.parameters.at("area_of_figure_7"), "7");
    image::Sheet sheet;
    sheet.rows = {{{canvas, "", false}}};
    write_sheet(plan, std::move(sheet), folder);
}

}  // namespace
}  // namespace figure_5

const Figure kFigure5{5, false, figure_5::plan, figure_5::draw};

}  // namespace strata::tools::figures
