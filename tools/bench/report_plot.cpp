#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "tools/bench/report.h"
#include "tools/report/machine.h"

namespace strata::tools::bench {

namespace {

using Measure = std::function<double(const Measurement&)>;

const char* title_of(Section section) {
    switch (section) {
        case Section::octaves:
            return "octaves";
        case Section::samples:
            return "samples a side";
        default:
            return "resolution";
    }
}

report::PlotSeries series_of(const Results& results, const Curve& curve, const Measure& quantity) {
    report::PlotSeries series;
    series.name = curve.name;
    series.style = report::PlotStyle::line_points;
    for (const CurvePoint& point : curve.points) {
        const Measurement* measured = find(results.measurements, point.id);
        if (measured == nullptr) continue;
        series.x.push_back(point.x);
        series.y.push_back(quantity(*measured));
    }
    return series;
}

// Every x that is measured gets its own tic.
void set_axis(report::PlotPanel& panel, const std::string& label) {
    panel.x.label = label;
    panel.x.log = true;
    std::vector<double> all;
    for (const report::PlotSeries& series : panel.series) all.insert(all.end(), series.x.begin(), series.x.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const double x : all) panel.x.tics.push_back({x, fmt::format("{}", x)});
    panel.x.min = all.front() / 1.15;
    panel.x.max = all.back() * 1.15;
}

void add_panel(report::Plot& plot, const Results& results, Section section, const std::string& what,
               const Measure& quantity) {
    report::PlotPanel panel;
    std::string axis;
    for (const Curve& curve : results.plan.curves) {
        if (curve.section != section) continue;
        axis = curve.axis;
        report::PlotSeries series = series_of(results, curve, quantity);
        if (!series.x.empty()) panel.series.push_back(std::move(series));
    }
    if (panel.series.empty()) return;
    panel.title = fmt::format("{} against {}", what, title_of(section));
    set_axis(panel, axis);
    panel.y.label = what;
    panel.y.min = 0;
    panel.legend = report::PlotLegend::bottom_right;
    plot.panels.push_back(std::move(panel));
}

// Stacked: each phase's area lies on those after it.
void add_shares(report::Plot& plot, const Results& results, const Curve& curve) {
    std::vector<std::string> names;
    std::vector<const Measurement*> all;
    std::vector<double> xs;
    for (const CurvePoint& point : curve.points) {
        const Measurement* measured = find(results.measurements, point.id);
        if (measured == nullptr || measured->phases.empty()) return;
        for (const Phase& phase : measured->phases) {
            if (std::ranges::find(names, phase.name) == names.end()) names.push_back(phase.name);
        }
        all.push_back(measured);
        xs.push_back(point.x);
    }
    report::PlotPanel panel;
    for (std::size_t first = 0; first < names.size(); ++first) {
        report::PlotSeries series{
            .name = names[first], .x = xs, .y = {}, .y_error = {}, .point_size = {}, .colour = {}};
        series.style = report::PlotStyle::filled;
        for (const Measurement* measured : all) {
            double total = 0, rest = 0;
            for (const Phase& phase : measured->phases) {
                const auto place = std::ranges::find(names, phase.name) - names.begin();
                total += phase.seconds;
                if (place >= static_cast<std::ptrdiff_t>(first)) rest += phase.seconds;
            }
            series.y.push_back(total > 0 ? 100 * rest / total : 0);
        }
        panel.series.push_back(std::move(series));
    }
    if (panel.series.empty() || xs.size() < 2) return;
    panel.title = fmt::format("share of time, {}", curve.name);
    set_axis(panel, curve.axis);
    panel.x.min = xs.front();
    panel.x.max = xs.back();
    panel.y = {.label = "time / %", .min = 0, .max = 100, .grid = false};
    panel.legend = report::PlotLegend::bottom_right;
    plot.panels.push_back(std::move(panel));
}

}  // namespace

report::Plot plot_report(const Results& results) {
    report::Plot plot;
    for (const Section section : {Section::octaves, Section::samples, Section::resolution}) {
        add_panel(plot, results, section, "ns a ray", [](const Measurement& m) { return m.ns_a_ray(Pick::least); });
        add_panel(plot, results, section, "evaluations a ray",
                  [](const Measurement& m) { return m.evaluations_a_ray(); });
    }
    for (const Curve& curve : results.plan.curves) add_shares(plot, results, curve);
    plot.title = fmt::format("strata bench, hyperterrain, one thread of {}", report::processor_name());
    plot.columns = plot.panels.size() > 1 ? 2 : 1;
    const int rows = (static_cast<int>(plot.panels.size()) + plot.columns - 1) / std::max(plot.columns, 1);
    plot.width = 560 * plot.columns;
    plot.height = 40 + 400 * std::max(rows, 1);
    return plot;
}

}  // namespace strata::tools::bench
