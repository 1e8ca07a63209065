#include <cmath>

#include "noise/simd_target.h"
#include "src/scene/enum_names.h"
#include "src/scene/printer.h"
#include "tools/cli/shared_options.h"
#include "tools/converge/report.h"
#include "tools/report/json.h"
#include "tools/report/machine.h"
#include "tools/report/statistics.h"
#include "tools/report/table.h"

namespace strata::tools::converge {

namespace {

using report::Json;
using report::number;

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

Json row_of(const Report& report, const Point& point) {
    const RootMean rmse = point.rmse();
    const std::optional<double> bias = visible_bias(report.experiment, point);
    const report::Spread seconds = report::spread_of(point.seconds);
    const report::Spread cpu = report::spread_of(point.cpu_seconds);
    Json row{{"function", report.function},
             {"estimator", scene::name_of(point.estimator)},
             {"m", point.m},
             {"N", point.N},
             {"tracer", cli::name_of(point.tracer)},
             {"seed_count", point.seeds()}};
    row.update(report::counts_json(point.counters));
    row.update({{"repeats", point.seconds.size()},
                {"seconds", seconds.median},
                {"seconds_low_quartile", seconds.low_quartile},
                {"seconds_high_quartile", seconds.high_quartile},
                {"cpu_seconds", cpu.median},
                {"cpu_seconds_low_quartile", cpu.low_quartile},
                {"cpu_seconds_high_quartile", cpu.high_quartile},
                {"rmse", number(rmse.value)},
                {"rmse_ci", number(rmse.half_width)},
                {"relative_rmse", number(mean(point.relative))},
                {"max_error", number(mean(point.largest))},
                {"percentile99", number(mean(point.percentile99))},
                {"neighbour_correlation", number(point.errors.neighbour_correlation())},
                {"bias_mean", number(point.errors.mean())},
                {"bias_rms", number(bias)},
                {"limited_by", limit_name(point.limit)}});
    return row;
}

Json slopes_json(const Analysis& analysis) {
    Json slopes = Json::array();
    for (const Series& series : analysis.series) {
        const auto add = [&](const char* against, const std::optional<PowerLaw>& law) {
            if (!law) return;
            slopes.push_back({{"estimator", scene::name_of(series.estimator)},
                              {"m", series.m},
                              {"tracer", cli::name_of(series.tracer)},
                              {"against", against},
                              {"slope", law->slope},
                              {"slope_ci", law->slope_ci},
                              {"factor", std::pow(10.0, law->log10_factor)},
                              {"points", law->points}});
        };
        add("samples", series.against_samples);
        add("seconds", series.against_seconds);
    }
    return slopes;
}

const char* reach_name(Reach reach) {
    if (reach == Reach::interpolated) return "interpolated";
    return reach == Reach::extrapolated ? "extrapolated" : "at the smallest N";
}

Json times_json(const Analysis& analysis) {
    Json times = Json::array();
    for (const Series& series : analysis.series) {
        for (std::size_t i = 0; i < kTargets.size(); ++i) {
            if (!series.times[i]) continue;
            Json entry{{"estimator", scene::name_of(series.estimator)}, {"m", series.m},
                       {"tracer", cli::name_of(series.tracer)},         {"error", kTargets[i]},
                       {"seconds", series.times[i]->seconds},           {"how", reach_name(series.times[i]->reach)}};
            entry["stratified_over_this"] = number(series.speed_ups[i]);
            times.push_back(std::move(entry));
        }
    }
    return times;
}

Json bias_json(const Analysis& analysis) {
    Json tests = Json::array();
    for (const BiasTest& test : analysis.tests) {
        tests.push_back({{"estimator", scene::name_of(test.point->estimator)},
                         {"m", test.point->m},
                         {"N", test.point->N},
                         {"tracer", cli::name_of(test.point->tracer)},
                         {"z_of_mean", number(test.z_of_mean)},
                         {"z_of_squares", number(test.z_of_squares)},
                         {"pass", !test.failed}});
    }
    return {{"family_level", analysis.family_level},
            {"threshold_of_mean", analysis.mean_threshold},
            {"threshold_of_squares", analysis.squares_threshold},
            {"tests", tests}};
}

Json references_json(const Experiment& experiment) {
    Json references = Json::array();
    for (const Reference& reference : experiment.references) {
        references.push_back({{"m", reference.m},
                              {"exact", reference.exact},
                              {"error", reference.error},
                              {"root_mean_square", reference.root_mean_square},
                              {"how", reference.how}});
    }
    return references;
}

}  // namespace

std::string converge_csv(const Report& report) {
    std::vector<Json> rows;
    for (const Point& point : report.experiment.points) rows.push_back(row_of(report, point));
    return report::csv_of(rows);
}

std::string converge_json(const Report& report) {
    const Experiment& experiment = report.experiment;
    Json rows = Json::array();
    for (const Point& point : experiment.points) rows.push_back(row_of(report, point));
    const Json json{{"function", report.function},
                    {"version", STRATA_VERSION},
                    {"width", experiment.scene.film.width},
                    {"height", experiment.scene.film.height},
                    {"machine",
                     {{"processor", report::processor_name()},
                      {"threads", experiment.settings.threads},
                      {"simd_target", noise::simd_target()}}},
                    {"first_seed", experiment.first_seed},
                    {"seeds", experiment.settings.seeds},
                    {"dropped_N", experiment.dropped_Ns},
                    {"interrupted", experiment.interrupted},
                    {"references", references_json(experiment)},
                    {"rows", rows},
                    {"slopes", slopes_json(report.analysis)},
                    {"time_to_error", times_json(report.analysis)},
                    {"bias", bias_json(report.analysis)},
                    {"scene", scene::print_scene(experiment.scene)}};
    return report::text_of(json);
}

}  // namespace strata::tools::converge
