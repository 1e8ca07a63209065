// Figure 7: an area of the surface through filters of higher and higher order.
#include "tools/figures/figure.h"
#include "tools/figures/surface_areas.h"

namespace strata::tools::figures {

namespace figure_7 {
namespace {

const DetailColumn kColumns[] = {{"none", "no anti-aliasing", false},
                                 {"m1", "m = 1, N = 10", true, 10, 1},
                                 {"m4", "m = 4, N = 10", true, 10, 4},
                                 {"m15", "m = 15, N = 10", true, 10, 15}};

Plan plan(Size size) {
    Plan result;
    result.number = 7;
    result.title = "Higher orders: blur grows with the filter's width";
    result.caption =
        "Another area of the surface of figure 5. From left to right: no anti-aliasing; B-splines of order m = 1 "
        "(box), 4 (cubic) and 15, each with 100 samples a pixel. The higher the order, the wider the filter, and the "
        "farther bright pixels spread into the dark.";
    result.chosen = {"the area"};
    result.shown = {{"figure-7.png",
                     "Four magnified pictures of the planet's ragged rim before a dark sky. Without anti-aliasing the "
                     "rim falls apart into single pixels; m = 1 is sharp, m = 4 softer, m = 15 plainly blurred."}};
    add_detail(result, size, detail_of_figure_7(size), kColumns);
    return result;
}

void draw(const Plan& plan, Pictures pictures, const std::filesystem::path& folder) {
    draw_detail(plan, pictures, folder, kColumns);
}

}  // namespace
}  // namespace figure_7

const Figure kFigure7{7, false, figure_7::plan, figure_7::draw};

}  // namespace strata::tools::figures
