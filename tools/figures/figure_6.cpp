// Figure 6: an area of the surface with more and more samples.
#include "tools/figures/figure.h"
#include "tools/figures/surface_areas.h"

namespace strata::tools::figures {

namespace figure_6 {
namespace {

const DetailColumn kColumns[] = {{"none", "no anti-aliasing", false},
                                 {"N2", "m = 4, N = 2", true, 2},
                                 {"N3", "m = 4, N = 3", true, 3},
                                 {"N10", "m = 4, N = 10", true, 10}};

Plan plan(Size size) {
    Plan result;
    result.number = 6;
    result.title = "More samples: from aliasing to noise to a smooth picture";
    result.caption =
        "An area of the surface of figure 5. From left to right: no anti-aliasing; the cubic B-spline with N = 2, 3 "
        "and 10, that is 4, 9 and 100 samples a pixel. Four samples turn the aliasing into noise, which fades as N "
        "grows.";
    result.chosen = {"the area"};
    result.shown = {{"figure-6.png",
                     "Four magnified pictures of white peaks in low sun. Without anti-aliasing, black and white pixels "
                     "lie scattered; with N = 2 they are grainy, with N = 3 less so, with N = 10 smooth."}};
    add_detail(result, size, detail_of_figure_6(size), kColumns);
    return result;
}

void draw(const Plan& plan, Pictures pictures, const std::filesystem::path& folder) {
    draw_detail(plan, pictures, folder, kColumns);
}

}  // namespace
}  // namespace figure_6

const Figure kFigure6{6, false, figure_6::plan, figure_6::draw};

}  // namespace strata::tools::figures
