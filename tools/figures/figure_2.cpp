// Figure 2: how many iterations the inverse distribution function takes. The paper's own figure is lost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/filter/bspline.h"
#include "src/filter/bspline_paper.h"
#include "tools/figures/figure.h"
#include "tools/report/plot.h"

namespace strata::tools::figures {

namespace figure_2 {
namespace {

constexpr int kOrders[] = {2, 3, 4, 8, 15};
constexpr int kClaimed = 8;  // "the number of iterations always remains small": at most 8
constexpr double kLeast = 1e-12;
constexpr int kPoints = 240;
constexpr double kErrorFloor_px = 1e-18;  // exact zeros are drawn here

// From kLeast to 1/2, evenly in the logarithm; the other half mirrors it.
std::vector<double> probabilities() {
    std::vector<double> y;
    const double span = std::log(0.5 / kLeast);
    for (int i = 0; i <= kPoints; ++i) y.push_back(i == kPoints ? 0.5 : kLeast * std::exp(span * i / kPoints));
    return y;
}

template <class Value>
std::vector<report::PlotSeries> curves(const Value& value) {
    std::vector<report::PlotSeries> all;
    for (const int m : kOrders) {
        report::PlotSeries series;
        series.name = fmt::format("m = {}", m);
        series.x = probabilities();
        for (const double y : series.x) series.y.push_back(value(m, y));
        all.push_back(std::move(series));
    }
    return all;
}

report::PlotPanel panel_of(const std::string& title, const std::string& y_label,
                           std::vector<report::PlotSeries> series) {
    report::PlotPanel panel;
    panel.title = title;
    panel.x = {.label = "y, the probability to be inverted", .log = true, .min = kLeast, .max = 0.5};
    panel.y.label = y_label;
    panel.series = std::move(series);
    return panel;
}

void mark_claim(report::PlotPanel& panel) {
    panel.markers.push_back({.kind = report::PlotMarker::Kind::horizontal,
                             .at = kClaimed,
                             .label = "8: the paper's \"always\"",
                             .label_at = 0.5});
}

report::PlotPanel newton_panel() {
    report::PlotPanel panel =
        panel_of("Newton's iterations from m/2 until |Δx| < 10⁻⁶ px (paper)", "iterations",
                 curves([](int m, double y) { return filter::paper::inverse_cdf_fast(m, y).iterations; }));
    panel.y.min = 0;
    mark_claim(panel);
    return panel;
}

report::PlotPanel halley_panel(const report::PlotAxis& axis) {
    report::PlotPanel panel = panel_of("Halley's steps on N_m^(1/m), to 10⁻¹³ px (ours)", "iterations",
                                       curves([](int m, double y) { return filter::bspline_invert(m, y).iterations; }));
    panel.y = axis;
    // Lines that lie on each other, drawn one inside the other.
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        panel.series[i].line_width = 1.5 * static_cast<double>(panel.series.size() - i);
    }
    mark_claim(panel);
    return panel;
}

report::PlotPanel error_panel() {
    const auto error = [](int m, double y) {
        const double stopped = filter::paper::inverse_cdf_fast(m, y, filter::paper::kTolerance, kClaimed).x;
        return std::max(std::abs(stopped - filter::bspline_invert(m, y).x), kErrorFloor_px);
    };
    report::PlotPanel panel = panel_of("Error left when Newton is stopped at 8", "error / px", curves(error));
    panel.y.log = true;
    panel.y.min = kErrorFloor_px;
    panel.y.max = 10;
    panel.legend = report::PlotLegend::bottom_left;
    panel.markers.push_back({.kind = report::PlotMarker::Kind::horizontal,
                             .at = filter::kInverseError,
                             .label = "ours, everywhere below",
                             .label_at = 0.6});
    return panel;
}

// The share of uniform y in (0,1) that needs more than the claimed number.
double share_beyond(int m) {
    constexpr int kTrials = 20'000;
    int beyond = 0;
    for (int i = 0; i < kTrials; ++i) {
        beyond += filter::paper::inverse_cdf_fast(m, 0.5 * (i + 0.5) / kTrials).iterations > kClaimed;
    }
    return static_cast<double>(beyond) / kTrials;
}

Plan plan(Size size) {
    Plan result;
    result.number = 2;
    result.title = "Iterations of the inverse distribution function";
    result.caption =
        "Left: iterations of plain Newton-Raphson from x = m/2, as the paper has it, until a step is shorter than a "
        "millionth of a pixel. In the middle of the distribution 8 are enough; towards y = 0, where N_m(x) is nearly "
        "x^m/m!, each step only divides the error by m/(m-1), and they are not. Middle: Halley's iteration on "
        "N_m^(1/m) from a start that knows both the tail and the middle, as this program does it. Right: how far off "
        "the paper's iteration is if it is stopped at 8. The half y > 1/2 mirrors what is shown.";
    result.chosen = {"the whole figure: the paper's figure 2 is lost", "the orders and the range of y",
                     "the tolerance of 10⁻⁶ px"};
    result.shown = {{"figure-2.png",
                     "Three plots over the probability y from 10⁻¹² to 1/2. Left: Newton's iterations stay at or below "
                     "8 near 1/2 and rise above 8, to 30 and more, towards small y. Middle: Halley's steps, two "
                     "everywhere or fewer. Right: the error left when Newton is stopped at 8 rises from nothing to "
                     "between 0.004 and 2.5 pixels towards small y."},
                    {"figure-2.svg", "The same plots as vector graphics."}};
    result.parameters = {{"orders", kOrders},
                         {"least_y", kLeast},
                         {"points", kPoints + 1},
                         {"newton_tolerance_px", filter::paper::kTolerance},
                         {"newton_start", "m/2"},
                         {"stopped_at", kClaimed},
                         {"halley_error_px", filter::kInverseError},
                         {"error_floor_px", kErrorFloor_px},
                         {"width_px", scaled(1500, size)},
                         {"height_px", scaled(560, size)}};
    for (const int m : kOrders) {
        result.parameters["share_of_uniform_y_beyond_8"][fmt::format("m={}", m)] = share_beyond(m);
    }
    return result;
}

void draw(const Plan& plan, Pictures, const std::filesystem::path& folder) {
    report::Plot plot;
    plot.columns = 3;
    plot.width = plan.parameters["width_px"];
    plot.height = plan.parameters["height_px"];
    plot.font_size = std::max(9, 12 * plot.width / 1500);
    report::PlotPanel newton = newton_panel();
    double most = 0;
    for (const report::PlotSeries& series : newton.series) most = std::max(most, *std::ranges::max_element(series.y));
    newton.y.max = most * 1.05;
    plot.panels = {newton, halley_panel(newton.y), error_panel()};
    for (const Shown& file : plan.shown) report::write_plot(plot, folder / file.file);
}

}  // namespace
}  // namespace figure_2

const Figure kFigure2{2, true, figure_2::plan, figure_2::draw};

}  // namespace strata::tools::figures
