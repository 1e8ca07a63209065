// Figure 3: where the samples of a pixel lie: the very ones that the renderer uses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/estimate/estimator.h"
#include "src/image/output_file.h"
#include "src/scene/enum_names.h"
#include "tools/figures/figure.h"
#include "tools/report/plot.h"

namespace strata::tools::figures {

namespace figure_3 {
namespace {

using scene::EstimatorKind;

constexpr int kN = 10;
constexpr int kOrder = 4;
constexpr int kPixel = 7;  // (7,7); any would do
constexpr const char* kData = "figure-3-samples.csv";
constexpr double kReach_px = 2.5;
constexpr double kLeastSize = 0.13;  // of the heaviest sample's dot: smaller ones would not be seen

struct Pattern {
    EstimatorKind kind;
    const char* title;
    double radius_px = 0.055;  // of the heaviest sample's dot
};

constexpr Pattern kPatterns[] = {
    {EstimatorKind::super, "super: grid on the pixel (box)", 0.03},
    {EstimatorKind::uniform, "uniform: grid with weights (2)"},
    {EstimatorKind::jittered, "jittered with weights (2)"},
    {EstimatorKind::stratified, "stratified by density (3)"},
    {EstimatorKind::random, "random by density"},
    {EstimatorKind::sobol, "sobol by density"},
    {EstimatorKind::shared, "shared: strata in every pixel"},
    {EstimatorKind::shared_sobol, "shared-sobol"},
};

std::vector<estimate::ProbeSample> samples_of(EstimatorKind kind) {
    estimate::EstimatorSettings settings;
    settings.kind = kind;
    settings.N = kN;
    settings.m = kOrder;
    return estimate::Estimator(settings).probe_samples(kPixel, kPixel);
}

report::PlotAxis axis(const char* label, bool downwards) {
    report::PlotAxis result{.label = label, .min = -kReach_px, .max = kReach_px};
    for (const double boundary : {-1.5, -0.5, 0.5, 1.5}) {
        result.tics.push_back({downwards ? -boundary : boundary, fmt::format("{:.1f}", boundary)});
    }
    return result;
}

report::PlotPanel panel_of(const Pattern& pattern) {
    report::PlotPanel panel;
    panel.title = pattern.title;
    panel.x = axis("u / px", false);
    panel.y = axis("v / px", true);
    panel.equal_scale = true;
    panel.legend = report::PlotLegend::none;
    for (const double side : {-0.5, 0.5}) {
        panel.markers.push_back({.kind = report::PlotMarker::Kind::vertical, .at = side, .label = "", .dashed = false});
        panel.markers.push_back(
            {.kind = report::PlotMarker::Kind::horizontal, .at = side, .label = "", .dashed = false});
    }
    report::PlotSeries dots;
    double heaviest = 0;
    const auto samples = samples_of(pattern.kind);
    for (const estimate::ProbeSample& sample : samples) heaviest = std::max(heaviest, sample.weight);
    for (const estimate::ProbeSample& sample : samples) {
        dots.x.push_back(sample.u);
        dots.y.push_back(-sample.v);
        dots.point_size.push_back(std::max(kLeastSize, std::sqrt(sample.weight / heaviest)));
    }
    dots.style = report::PlotStyle::discs;
    dots.point_scale = pattern.radius_px;
    dots.colour = 0;
    report::PlotSeries centre;
    centre.x = {0};
    centre.y = {0};
    centre.style = report::PlotStyle::points;
    centre.shape = report::PlotShape::diamond;
    centre.point_scale = 1.3;
    centre.colour = 1;
    panel.series = {dots, centre};
    return panel;
}

std::string samples_text() {
    std::string text = "estimator,u_px,v_px,weight\n";
    for (const Pattern& pattern : kPatterns) {
        for (const estimate::ProbeSample& sample : samples_of(pattern.kind)) {
            text += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", scene::name_of(pattern.kind), sample.u, sample.v,
                                sample.weight);
        }
    }
    return text;
}

Plan plan(Size size) {
    Plan result;
    result.number = 3;
    result.title = "Sampling patterns of a pixel";
    result.caption =
        "The samples of one pixel at N = 10, as the renderer takes them, the area of a dot in proportion to its "
        "weight; pixel boundaries in grey, the pixel itself outlined darker, a diamond at its centre. Upper row, after "
        "the paper: a regular grid over the pixel, which is a box filter; a regular grid on the cubic's support of 4×4 "
        "pixels, weighted by the filter (2); the same jittered; and N×N strata of probability through the inverse "
        "distribution, all of the same weight (3). Lower row, beyond the paper: the same without strata; "
        "Owen-scrambled Sobol points; strata and Sobol points in every pixel, each shared by the 4×4 pixels around it, "
        "so that 1600 count in this one.";
    result.chosen = {
        "the lower row",
        "the third pattern: the paper's text has 'stratified with weights', which is the jittered grid here",
        "dots drawn with their weight as area, but never too small to be seen, and smaller in the first pattern"};
    result.shown = {{"figure-3.png",
                     "Eight squares of five by five pixels with sample points. A regular grid within the centre pixel; "
                     "regular and jittered grids over four by four pixels, dots shrinking outwards; stratified points, "
                     "dense at the centre and sparse outwards; the same at random with clumps, by Sobol points "
                     "without, and 1600 shared points with dots shrinking outwards."},
                    {"figure-3.svg", "The same plots as vector graphics."}};
    result.data = {kData};
    for (const Pattern& pattern : kPatterns) result.parameters["estimators"].push_back(scene::name_of(pattern.kind));
    result.parameters.update({{"N", kN},
                              {"m", kOrder},
                              {"seed", estimate::EstimatorSettings().seed},
                              {"pixel", {kPixel, kPixel}},
                              {"width_px", scaled(1480, size)},
                              {"height_px", scaled(820, size)}});
    return result;
}

void draw(const Plan& plan, Pictures, const std::filesystem::path& folder) {
    const std::string text = samples_text();
    image::replace_file(folder / kData, text);
    report::Plot plot;
    plot.columns = 4;
    plot.width = plan.parameters["width_px"];
    plot.height = plan.parameters["height_px"];
    plot.font_size = std::max(7, 11 * plot.width / 1480);
    for (const Pattern& pattern : kPatterns) plot.panels.push_back(panel_of(pattern));
    for (const Shown& file : plan.shown) report::write_plot(plot, folder / file.file);
}

}  // namespace
}  // namespace figure_3

const Figure kFigure3{3, true, figure_3::plan, figure_3::draw};

}  // namespace strata::tools::figures
