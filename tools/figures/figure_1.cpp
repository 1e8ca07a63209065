// Figure 1: B-splines and the magnitude of their Fourier transforms, beside the Gaussians that they tend to.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/filter/bspline.h"
#include "tools/figures/figure.h"
#include "tools/report/plot.h"

namespace strata::tools::figures {

namespace figure_1 {
namespace {

constexpr int kOrders[] = {1, 2, 3, 4, 8, 15};
constexpr int kGaussianOrders[] = {1, 4, 15};
constexpr double kNyquist = 0.5;  // cycles a pixel
constexpr double kFloor_dB = -140;
constexpr double kReach_px = 5;
constexpr double kHighest = 2.5;  // cycles a pixel

double sinc(double f) { return f == 0 ? 1 : std::sin(std::numbers::pi * f) / (std::numbers::pi * f); }
double gain(int m, double f) { return std::pow(std::abs(sinc(f)), m); }
double gaussian(int m, double x) {
    const double variance = m / 12.0;
    return std::exp(-0.5 * x * x / variance) / std::sqrt(2 * std::numbers::pi * variance);
}
double gaussian_gain(int m, double f) {
    return std::exp(-2 * std::numbers::pi * std::numbers::pi * f * f * (m / 12.0));
}
double decibels(double g) { return g > 0 ? std::max(20 * std::log10(g), kFloor_dB) : kFloor_dB; }

template <class Function>
report::PlotSeries curve(const std::string& name, int colour, double from, double to, const Function& function) {
    report::PlotSeries series;
    series.name = name;
    series.colour = colour;
    constexpr int kSteps = 1000;
    for (int i = 0; i <= kSteps; ++i) {
        const double x = from + (to - from) * i / kSteps;
        series.x.push_back(x);
        series.y.push_back(function(x));
    }
    return series;
}

int colour_of(int m) {
    return static_cast<int>(std::find(std::begin(kOrders), std::end(kOrders), m) - std::begin(kOrders));
}

// value(m, x) for every order, and dashed the Gaussians of some.
template <class Spline, class Gaussian>
std::vector<report::PlotSeries> curves(double from, double to, const Spline& spline, const Gaussian& limit) {
    std::vector<report::PlotSeries> all;
    for (const int m : kOrders) {
        all.push_back(curve(fmt::format("m = {}", m), colour_of(m), from, to, [&](double x) { return spline(m, x); }));
    }
    for (const int m : kGaussianOrders) {
        all.push_back(curve(m == kGaussianOrders[0] ? "Gaussian" : "", colour_of(m), from, to,
                            [&](double x) { return limit(m, x); }));
        all.back().style = report::PlotStyle::dashed;
        all.back().line_width = 1.5;
    }
    return all;
}

// The gains at Nyquist as points, with their values in the legend.
template <class Value, class Text>
void mark_nyquist(report::PlotPanel& panel, const Value& value, const Text& text) {
    panel.markers.push_back(
        {.kind = report::PlotMarker::Kind::vertical, .at = kNyquist, .label = "Nyquist", .label_at = 0.96});
    for (const int m : kOrders) {
        report::PlotSeries point;
        point.x = {kNyquist};
        point.y = {value(gain(m, kNyquist))};
        point.name = fmt::format("m = {}: {}", m, text(gain(m, kNyquist)));
        point.style = report::PlotStyle::points;
        point.shape = report::PlotShape::dot;
        point.colour = colour_of(m);
        panel.series.push_back(std::move(point));
    }
}

report::PlotPanel density_panel() {
    report::PlotPanel panel;
    panel.title = "B-splines n_m, centred";
    panel.x = {.label = "x / px", .min = -kReach_px, .max = kReach_px};
    panel.y = {.label = "n_m(x + m/2) / px⁻¹", .min = 0, .max = 1.45};
    panel.series = curves(
        -kReach_px, kReach_px, [](int m, double x) { return filter::bspline_pdf(m, x + 0.5 * m); }, gaussian);
    return panel;
}

report::PlotPanel gain_panel() {
    report::PlotPanel panel;
    panel.title = "Magnitude of their Fourier transforms";
    panel.x = {.label = "f / cycles a pixel", .min = 0, .max = kHighest};
    panel.y = {.label = "|n̂_m(f)|", .min = 0, .max = 1};
    panel.series = curves(0, kHighest, gain, gaussian_gain);
    for (report::PlotSeries& series : panel.series) series.name.clear();
    mark_nyquist(
        panel, [](double g) { return g; }, [](double g) { return fmt::format("{:.3g}", g); });
    return panel;
}

report::PlotPanel decibel_panel() {
    report::PlotPanel panel;
    panel.title = "The same in decibels";
    panel.x = {.label = "f / cycles a pixel", .min = 0, .max = kHighest};
    panel.y = {.label = "20 log₁₀ |n̂_m(f)| / dB", .min = kFloor_dB, .max = 5};
    panel.series = curves(
        0, kHighest, [](int m, double f) { return decibels(gain(m, f)); },
        [](int m, double f) { return decibels(gaussian_gain(m, f)); });
    for (report::PlotSeries& series : panel.series) series.name.clear();
    mark_nyquist(panel, decibels, [](double g) { return fmt::format("{:.1f} dB", decibels(g)); });
    panel.legend = report::PlotLegend::none;
    return panel;
}

Plan plan(Size size) {
    Plan result;
    result.number = 1;
    result.title = "B-splines and their Fourier transforms";
    result.caption =
        "The uniform B-splines n_m of order m = 1 (box), 2 (tent), 3, 4 (cubic), 8 and 15, centred on the pixel, and "
        "the magnitude of their Fourier transforms, |sinc(f)|ᵐ, on a linear scale and in decibels. Dashed: the "
        "Gaussians of the same variance, m/12, that the splines tend to. Dots: what each leaves of a wave at Nyquist's "
        "frequency, half a cycle a pixel: (2/π)ᵐ = 0.637, 0.405, 0.258 and 0.164 for m = 1 to 4.";
    result.chosen = {"the orders shown, beyond what the text names",
                     "the range of frequencies and the floor of -140 dB"};
    result.shown = {{"figure-1.png",
                     "Three plots. Left: B-splines of order 1 to 15, from a box to a wide bell. Middle: their spectra, "
                     "falling from 1 at frequency 0, faster for higher orders. Right: the same in decibels, with zeros "
                     "at every whole frequency; higher orders have side lobes that lie far lower."},
                    {"figure-1.svg", "The same plots as vector graphics."}};
    result.parameters = {
        {"orders", kOrders},     {"gaussian_orders", kGaussianOrders}, {"nyquist_cycles_per_px", kNyquist},
        {"floor_dB", kFloor_dB}, {"width_px", scaled(1500, size)},     {"height_px", scaled(560, size)}};
    for (const int m : kOrders) result.parameters["gain_at_nyquist"].push_back(gain(m, kNyquist));
    return result;
}

void draw(const Plan& plan, Pictures, const std::filesystem::path& folder) {
    report::Plot plot;
    plot.columns = 3;
    plot.width = plan.parameters["width_px"];
    plot.height = plan.parameters["height_px"];
    plot.font_size = std::max(9, 12 * plot.width / 1500);
    plot.panels = {density_panel(), gain_panel(), decibel_panel()};
    for (const Shown& file : plan.shown) report::write_plot(plot, folder / file.file);
}

}  // namespace
}  // namespace figure_1

const Figure kFigure1{1, true, figure_1::plan, figure_1::draw};

}  // namespace strata::tools::figures
