#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "noise/simd_target.h"
#include "src/scene/enum_names.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/shared_options.h"
#include "tools/converge/report.h"
#include "tools/report/machine.h"
#include "tools/report/table.h"

namespace strata::tools::converge {

namespace {

using scene::EstimatorKind;

std::string time_text(double seconds) {
    if (seconds < 1e-3) return fmt::format("{:.3g} µs", 1e6 * seconds);
    if (seconds < 1) return fmt::format("{:.3g} ms", 1e3 * seconds);
    return seconds < 100 ? fmt::format("{:.3g} s", seconds) : cli::duration_text(seconds);
}

std::string target_text(double target) { return fmt::format("1/{:.0f}", 1 / target); }

// "~" before what is extrapolated, "<=" before what the smallest N reaches already.
std::string reach_mark(Reach reach) {
    return reach == Reach::extrapolated ? "~" : reach == Reach::at_first ? "≤ " : "";
}

std::string time_cell(const Series& series, std::size_t target) {
    if (!series.times[target]) return "-";
    const TimeToError& time = *series.times[target];
    const std::string text = reach_mark(time.reach) + time_text(time.seconds);
    const auto& speed_up = series.speed_ups[target];
    return speed_up ? fmt::format("{} ({:.2g}×)", text, *speed_up) : text;
}

std::string series_name(const Experiment& experiment, const Series& series) {
    std::string name(scene::name_of(series.estimator));
    if (experiment.settings.tracers.size() > 1) name += fmt::format(", {} tracer", cli::name_of(series.tracer));
    return name;
}

// Of the largest N that says something.
std::string correlation_text(const Series& series) {
    for (auto point = series.points.rbegin(); point != series.points.rend(); ++point) {
        if ((*point)->limit == Limit::none) return fmt::format("{:.2f}", (*point)->errors.neighbour_correlation());
    }
    return "-";
}

std::string setting_text(const Report& report) {
    const Experiment& e = report.experiment;
    std::string text = fmt::format(
        "`{}`, {} × {} pixels. Errors are of linear radiance against the same filter's picture, over {} seeds from {}. "
        "Times are of the CPU, medians of at least {} interleaved renders on {} thread{} of {} ({}); those by the "
        "clock are in the files.\n",
        report.function, e.scene.film.width, e.scene.film.height, e.settings.seeds, e.first_seed, e.settings.repeats,
        e.settings.threads, e.settings.threads == 1 ? "" : "s", report::processor_name(), noise::simd_target());
    if (!e.dropped_Ns.empty()) {
        text += fmt::format("The time given did not suffice for N = {}{}.\n", e.dropped_Ns.front(),
                            e.dropped_Ns.size() > 1 ? fmt::format(" to {}", e.dropped_Ns.back()) : "");
    }
    if (e.interrupted) text += "Interrupted: some points rest on fewer seeds, or are missing.\n";
    for (const Reference& reference : e.references) {
        text += fmt::format("Reference for m = {}: {}; {} {:.2g}.\n", reference.m, reference.how,
                            reference.exact ? "no pixel is off by more than" : "its own RMSE, told from the halves, is",
                            reference.error);
    }
    return text;
}

// Errors of these are the same in every render: patterns, where others have grain.
bool is_grid(EstimatorKind kind) { return scene::row_of(kind).is_grid(); }

const Series* fastest(const Report& report, int m, std::size_t target, bool grids) {
    const Series* best = nullptr;
    for (const Series& series : report.analysis.series) {
        if (series.m != m || !series.times[target] || is_grid(series.estimator) != grids) continue;
        if (series.tracer != report.experiment.settings.tracers.front()) continue;
        if (best == nullptr || series.times[target]->seconds < best->times[target]->seconds) best = &series;
    }
    return best;
}

std::string advice(const Report& report, int m, std::size_t target) {
    const Series* best = fastest(report, m, target, false);
    const Series* grid = fastest(report, m, target, true);
    std::string text = fmt::format("- m = {}, error {}: ", m, target_text(kTargets[target]));
    if (best == nullptr && grid == nullptr) return text + "nothing measured here comes near.\n";
    if (best != nullptr) {
        const TimeToError& time = *best->times[target];
        text +=
            fmt::format("`{}`, {}{}", scene::name_of(best->estimator), reach_mark(time.reach), time_text(time.seconds));
        if (best->estimator == EstimatorKind::stratified) {
            text += ", the paper's method itself";
        } else if (const auto& speed_up = best->speed_ups[target]; speed_up && *speed_up < 1.05) {
            text += ", no faster than the paper's method to speak of";
        } else if (speed_up) {
            text += fmt::format(", {:.2g} times as fast as the paper's method", *speed_up);
        }
    }
    if (grid != nullptr && (best == nullptr || grid->times[target]->seconds < best->times[target]->seconds)) {
        const TimeToError& time = *grid->times[target];
        text += fmt::format("{}`{}`, {}{}, if patterns are no worse than grain", best != nullptr ? "; " : "",
                            scene::name_of(grid->estimator), reach_mark(time.reach), time_text(time.seconds));
    }
    return text + ".\n";
}

std::string advice(const Report& report) {
    std::string text = "## What to pick\n\n";
    std::vector<int> orders;
    for (const Series& series : report.analysis.series) {
        if (std::ranges::find(orders, series.m) == orders.end()) orders.push_back(series.m);
    }
    std::ranges::sort(orders);
    for (const int m : orders) {
        for (std::size_t target = 0; target < kTargets.size(); ++target) text += advice(report, m, target);
    }
    return text +
           "\nThe least time for the error asked for; where one sample a pixel suffices (≤), any will do. Errors of "
           "`shared` and `shared-sobol` spread over neighbouring pixels (last column below): at equal RMSE their grain "
           "is coarser. Errors of `super` and `uniform` are the same in every render: they show as patterns, not as "
           "grain.\n";
}

std::string table(const Report& report) {
    report::Table table({"m", "estimator", "slope against samples", "RMSE / stratified, equal N", "1/64", "1/256",
                         "1/1024", "neighbours' correlation"});
    std::vector<const Series*> sorted;
    for (const Series& series : report.analysis.series) sorted.push_back(&series);
    std::ranges::stable_sort(sorted, {}, [](const Series* series) { return series->m; });
    for (const Series* series : sorted) {
        const auto& law = series->against_samples;
        std::vector<std::string> cells{fmt::format("{}", series->m), series_name(report.experiment, *series),
                                       law ? fmt::format("{:.2f} ± {:.2f}", law->slope, law->slope_ci) : "-",
                                       series->error_ratio ? fmt::format("{:.2f}", *series->error_ratio) : "-"};
        for (std::size_t target = 0; target < kTargets.size(); ++target) cells.push_back(time_cell(*series, target));
        cells.push_back(correlation_text(*series));
        table.add(std::move(cells));
    }
    return "## Time to reach an error\n\n" + table.markdown() +
           "\nIn brackets: the paper's method's time (`stratified`, same order) over this one's. ~: extrapolated along "
           "the fitted slope; ≤: the smallest N is below already. Slopes are of RMSE against N², with 95 % intervals; "
           "theory knows -1/2 for independent samples, -3/4 for strata across an edge, -1 for strata on smooth "
           "pictures.\n";
}

std::string bias_text(const Report& report) {
    const Analysis& analysis = report.analysis;
    if (analysis.tests.empty()) {
        return "Bias was not tested: that takes an exact picture, random samples and two seeds.\n";
    }
    std::string failures;
    for (const BiasTest& test : analysis.tests) {
        if (!test.failed) continue;
        failures += fmt::format("- **{} m = {} N = {}: z = {:.2f} in the mean, {:.2f} in the squares**\n",
                                scene::name_of(test.point->estimator), test.point->m, test.point->N, test.z_of_mean,
                                test.z_of_squares);
    }
    std::string text = fmt::format(
        "Bias: {} points of `stratified`, `random` and `sobol` were tested against the exact picture, in the picture's "
        "mean (|z| ≤ {:.2f}) and pixel by pixel (z ≤ {:.2f}); an unbiased estimator would fail any of them with a "
        "probability of {:.0f} % (Šidák). {}\n",
        analysis.tests.size(), analysis.mean_threshold, analysis.squares_threshold, 100 * analysis.family_level,
        failures.empty() ? "None failed." : "These failed:\n\n" + failures);
    return text;
}

// The estimators with normalised weights, where their bias stands out of the noise.
std::string weighted_bias_text(const Report& report) {
    std::string text;
    for (const Series& series : report.analysis.series) {
        if (unbiased(series.estimator) || series.points.front()->fixed) continue;
        std::string list;
        for (const Point* point : series.points) {
            if (point->seeds() < 2 || point->limit != Limit::none) continue;
            const auto rms = visible_bias(report.experiment, *point);
            if (rms) list += fmt::format("{}{:.2g} at N = {}", list.empty() ? "" : ", ", *rms, point->N);
        }
        text += fmt::format("- `{}`, m = {}: {}\n", series_name(report.experiment, series), series.m,
                            list.empty() ? "below the noise at every N" : list);
    }
    if (text.empty()) return text;
    return "\nBias of the estimators that divide by a sum of weights (root mean square over pixels, where it stands "
           "out of the noise):\n\n" +
           text;
}

std::string limits_text(const Report& report) {
    int by_reference = 0;
    int by_rounding = 0;
    for (const Point& point : report.experiment.points) {
        by_reference += point.limit == Limit::reference;
        by_rounding += point.limit == Limit::rounding;
    }
    std::string text;
    if (by_reference > 0) {
        text += fmt::format(
            "\n{} points are reference-limited (within three times the reference's own error): they are marked in the "
            "files and left out of slopes and times.\n",
            by_reference);
    }
    if (by_rounding > 0) {
        text += fmt::format(
            "\n{} points err by no more than the rounding of radiance to floats: exact, as far as this can tell.\n",
            by_rounding);
    }
    if (report.experiment.settings.tracers.size() > 1) {
        text +=
            "\nThe reference is traced by the fast tracer: the other's hits differ within the tolerance, which its "
            "errors include.\n";
    }
    return text;
}

}  // namespace

std::string converge_summary(const Report& report) {
    return fmt::format("# Error against time: {}\n\n", report.function) + setting_text(report) + "\n" + advice(report) +
           "\n" + table(report) + "\n## How far to trust it\n\n" + bias_text(report) + weighted_bias_text(report) +
           limits_text(report);
}

}  // namespace strata::tools::converge
