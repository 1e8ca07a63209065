// Figure 4: test patterns without antialiasing, through a box and through the cubic B-spline.
#include <fmt/format.h>

#include "tools/figures/figure.h"

namespace strata::tools::figures {

namespace figure_4 {
namespace {

constexpr int kSide = 320;  // px, at size paper
constexpr int kN = 10;
constexpr double kRingsPerPixel = 0.5;  // of the half side: one ring a pixel at the edge, twice Nyquist's frequency
constexpr double kPatternCost = 0.03;

struct Filter {
    const char* name;
    const char* label;
    scene::EstimatorKind estimator;
    int m;
};

constexpr Filter kFilters[] = {
    {"none", "no anti-aliasing", scene::EstimatorKind::none, 1},
    {"box", "box, m = 1, N = 10", scene::EstimatorKind::stratified, 1},
    {"cubic", "cubic, m = 4, N = 10", scene::EstimatorKind::stratified, 4},
};

struct TestPattern {
    const char* name;
    const char* label;
    scene::Scene (*scene)(int side);
};

scene::Scene zoneplate(int side) {
    scene::Scene scene = builtin("zoneplate");
    scene.zoneplate.rings = kRingsPerPixel * 0.5 * side;
    return scene;
}

scene::Scene checker(int) {
    scene::Scene scene = builtin("checker");
    scene.checker.horizon = 0.15;
    scene.checker.square = 0.5;
    return scene;
}

constexpr TestPattern kPatterns[] = {{"zoneplate", "zone plate", zoneplate}, {"checker", "receding checker", checker}};

Part part_of(const TestPattern& pattern, const Filter& filter, Size size) {
    const int side = scaled(kSide, size);
    scene::Scene scene = pattern.scene(side);
    scene.film.width = scene.film.height = side;
    scene.sampling.estimator = filter.estimator;
    scene.sampling.N = kN;
    scene.sampling.m = filter.m;
    return {fmt::format("figure-4-{}-{}.exr", pattern.name, filter.name), scene, {0, 0, side, side}, kPatternCost};
}

Plan plan(Size size) {
    Plan result;
    result.number = 4;
    result.title = "Anti-aliasing test patterns";
    result.caption =
        "From left to right: no anti-aliasing, a box filter and the cubic B-spline. The zone plate's rings are one "
        "pixel wide at the nearer edge, twice Nyquist's frequency. Without anti-aliasing false centres appear as "
        "bright as the true one. The box leaves faint ones: it lets 64 % of a wave at Nyquist's frequency through and "
        "its side lobes 22 % beyond one ring a pixel. The cubic, with 16 % and 0.2 %, fades to an even grey. Likewise "
        "the moiré at the checker's horizon.";
    result.chosen = {"both patterns: the paper's own is lost", "the rings' number, the checker's size and horizon"};
    result.shown = {{"figure-4.png",
                     "Two rows of three pictures. A zone plate: with no anti-aliasing, strong false ring systems at "
                     "the edges; with a box, faint ones; with the cubic, rings that fade to grey. A chequered plane: "
                     "moiré towards the horizon, less with the box, none with the cubic."}};
    for (const TestPattern& pattern : kPatterns) {
        const auto file = [&](const Filter& filter) {
            return fmt::format("figure-4-{}-{}.png", pattern.name, filter.name);
        };
        for (const Filter& filter : kFilters) {
            result.parts.push_back(part_of(pattern, filter, size));
            result.shown.push_back({file(filter), fmt::format("The {}: {}.", pattern.label, filter.label)});
        }
        result.comparisons.push_back({file(kFilters[0]), file(kFilters[2]), kFilters[0].label, kFilters[2].label});
        result.comparisons.push_back({file(kFilters[1]), file(kFilters[2]), kFilters[1].label, kFilters[2].label});
    }
    return result;
}

void draw(const Plan& plan, Pictures pictures, const std::filesystem::path& folder) {
    image::Sheet sheet;
    for (const Filter& filter : kFilters) sheet.column_labels.emplace_back(filter.label);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (i % std::size(kFilters) == 0) sheet.rows.emplace_back();
        sheet.rows.back().push_back({image::to_canvas(pictures[i]), "", false});
        image::write_canvas(folder / plan.shown[i + 1].file, sheet.rows.back().back().picture);
    }
    write_sheet(plan, std::move(sheet), folder);
}

}  // namespace
}  // namespace figure_4

const Figure kFigure4{4, false, figure_4::plan, figure_4::draw};

}  // namespace strata::tools::figures
