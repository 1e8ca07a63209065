#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/scene/enum_names.h"
#include "tools/cli/shared_options.h"
#include "tools/converge/report.h"
#include "tools/report/statistics.h"

namespace strata::tools::converge {

namespace {

struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;

    void hold(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

constexpr int kBlack = 5;  // of plot_palette()

// One colour and shape an estimator, in every panel; the paper's is black.
struct Look {
    int colour;
    report::PlotShape shape;
};

// In the order of the table of estimators; those that come after begin anew.
constexpr std::array kLooks{
    Look{7, report::PlotShape::dot},      Look{7, report::PlotShape::triangle},     Look{2, report::PlotShape::square},
    Look{3, report::PlotShape::triangle}, Look{kBlack, report::PlotShape::diamond}, Look{4, report::PlotShape::cross},
    Look{6, report::PlotShape::circle},   Look{1, report::PlotShape::dot},          Look{0, report::PlotShape::square}};

Look look_of(scene::EstimatorKind kind) { return kLooks[static_cast<std::size_t>(kind) % kLooks.size()]; }

std::string with_slope(const Series& series, const std::optional<PowerLaw>& law) {
    const std::string name(scene::name_of(series.estimator));
    return law ? fmt::format("{}  {:.2f} ± {:.2f}", name, law->slope, law->slope_ci) : name;
}

class Panel {
  public:
    Panel(const Report& report, PlotAgainst against, int m, integrate::Tracer tracer) : against_(against) {
        for (const Series& series : report.analysis.series) {
            if (series.m == m && series.tracer == tracer) add(series);
        }
        if (panel_.series.empty()) return;
        add_theory();
        const bool traced = report.experiment.settings.tracers.size() > 1;
        panel_.title = fmt::format("m = {}{}", m, traced ? fmt::format(", {} tracer", cli::name_of(tracer)) : "");
        panel_.x.label = against == PlotAgainst::samples ? "samples a pixel, N²" : "CPU time of a render / s";
        panel_.y.label = "RMSE of linear radiance";
        panel_.x.log = panel_.y.log = true;
        panel_.y.min = y_.low / 1.5;
        panel_.y.max = y_.high * 1.5;
        panel_.x.min = x_.low / 1.3;
        panel_.x.max = x_.high * 1.3;
        panel_.legend = report::PlotLegend::right;
    }

    const report::PlotPanel& panel() const { return panel_; }

  private:
    double x_of(const Point& point) const {
        return against_ == PlotAgainst::samples ? 1.0 * point.N * point.N : report::spread_of(point.cpu_seconds).median;
    }

    void add(const Series& series) {
        const std::optional<PowerLaw>& law =
            against_ == PlotAgainst::samples ? series.against_samples : series.against_seconds;
        report::PlotSeries points;
        points.name = with_slope(series, law);
        points.style = law ? report::PlotStyle::points : report::PlotStyle::line_points;
        points.colour = look_of(series.estimator).colour;
        points.shape = look_of(series.estimator).shape;
        report::PlotSeries line;
        line.colour = points.colour;
        line.line_width = 1.5;
        // The fit may have left out the first points.
        const auto usable =
            std::ranges::count_if(series.points, [](const Point* point) { return point->limit == Limit::none; });
        const auto skipped = law ? usable - law->points : 0;
        std::ptrdiff_t fitted = 0;
        for (const Point* point : series.points) {
            const RootMean rmse = point->rmse();
            if (!(rmse.value > 0) || point->limit == Limit::rounding) continue;
            points.x.push_back(x_of(*point));
            points.y.push_back(rmse.value);
            points.y_error.push_back(std::isfinite(rmse.half_width) ? rmse.half_width : 0);
            x_.hold(points.x.back());
            y_.hold(rmse.value);
            if (law && point->limit == Limit::none && fitted++ >= skipped) {
                line.x.push_back(points.x.back());
                line.y.push_back(law->at(points.x.back()));
            }
        }
        if (points.x.empty()) return;
        if (line.x.size() > 1) panel_.series.push_back(line);
        panel_.series.push_back(std::move(points));
    }

    // From the panel's top left corner downwards: only the directions mean anything.
    void add_theory() {
        if (!(x_.high > x_.low)) return;
        struct Theory {
            double slope;
            const char* name;
        };
        for (const Theory& theory : {Theory{-0.5, "-1/2: independent samples"}, Theory{-0.75, "-3/4: strata, an edge"},
                                     Theory{-1.0, "-1: strata, smooth"}}) {
            const double bottom = x_.low * std::pow(y_.low / y_.high, 1 / theory.slope);
            const double end = std::min(x_.high, bottom);
            report::PlotSeries line;
            line.name = theory.name;
            line.style = theory.slope == -0.5   ? report::PlotStyle::dotted
                         : theory.slope == -1.0 ? report::PlotStyle::line
                                                : report::PlotStyle::dashed;
            line.colour = kBlack;
            line.line_width = 0.7;
            line.x = {x_.low, end};
            line.y = {y_.high, y_.high * std::pow(end / x_.low, theory.slope)};
            panel_.series.push_back(std::move(line));
        }
    }

    PlotAgainst against_;
    report::PlotPanel panel_;
    Extent x_, y_;
};

}  // namespace

report::Plot converge_plot(const Report& report, PlotAgainst against) {
    const Experiment& experiment = report.experiment;
    report::Plot plot;
    plot.title = fmt::format("{}: error against {}, with fitted slopes", report.function,
                             against == PlotAgainst::samples ? "samples" : "time");
    for (const integrate::Tracer tracer : experiment.settings.tracers) {
        std::vector<int> orders;
        for (const Series& series : report.analysis.series) {
            if (std::ranges::find(orders, series.m) == orders.end()) orders.push_back(series.m);
        }
        std::ranges::sort(orders);
        for (const int m : orders) {
            const Panel panel(report, against, m, tracer);
            if (!panel.panel().series.empty()) plot.panels.push_back(panel.panel());
        }
    }
    plot.columns = 1;
    plot.width = 1000;
    plot.height = 560 * std::max(static_cast<int>(plot.panels.size()), 1);
    return plot;
}

}  // namespace strata::tools::converge
