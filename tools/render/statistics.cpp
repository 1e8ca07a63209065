#include "tools/render/statistics.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "noise/simd_target.h"
#include "tools/cli/progress_printer.h"
#include "tools/report/json.h"
#include "tools/report/text.h"

namespace strata::tools::render {

namespace {

std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

const char* end_name(strata::render::PassesEnd end) {
    switch (end) {
        case strata::render::PassesEnd::passes:
            return "passes";
        case strata::render::PassesEnd::target:
            return "target-rmse";
        case strata::render::PassesEnd::time:
            return "time-limit";
        case strata::render::PassesEnd::cancelled:
            return "interrupted";
        case strata::render::PassesEnd::not_finite:
            return "not finite";
    }
    return "";
}

std::string verdict(const PassStatistics& passes) {
    if (passes.end == strata::render::PassesEnd::not_finite) return "some radiance is not finite: no error can be told";
    if (passes.goal.target_rmse <= 0) return passes.end == strata::render::PassesEnd::time ? "time limit reached" : "";
    const bool reached = passes.end == strata::render::PassesEnd::target;
    return fmt::format("target {:.3g} {}", passes.goal.target_rmse,
                       reached                                              ? "reached"
                       : passes.end == strata::render::PassesEnd::time      ? "not reached in time"
                       : passes.end == strata::render::PassesEnd::cancelled ? "not yet reached"
                                                                            : "not reached in these passes");
}

std::string passes_summary(const PassStatistics& passes) {
    std::string text = fmt::format("passes   {}", passes.passes);
    if (passes.error && std::isfinite(passes.error->high)) {
        text += fmt::format(", sampling error {:.3g} RMSE (95 % sure: below {:.3g})", passes.error->rmse,
                            passes.error->high);
    } else if (passes.error) {
        text += fmt::format(", sampling error about {:.3g} RMSE", passes.error->rmse);
    }
    const std::string said = verdict(passes);
    return text + (said.empty() ? "" : ", ") + said + "\n";
}

report::Json passes_json(const PassStatistics& passes) {
    const strata::render::ErrorEstimate error = passes.error.value_or(strata::render::ErrorEstimate{});
    const bool known = passes.error.has_value();
    report::Json predicted = nullptr;
    if (passes.predicted_passes) predicted = *passes.predicted_passes;
    return {{"passes", passes.passes},
            {"stopped_by", end_name(passes.end)},
            {"estimated_rmse", report::number(error.rmse, known)},
            {"estimated_rmse_low", report::number(error.low, known)},
            {"estimated_rmse_high", report::number(error.high, known)},
            {"estimated_bias", report::number(error.bias, known)},
            {"target_rmse", report::number(passes.goal.target_rmse, passes.goal.target_rmse > 0)},
            {"time_limit_s", report::number(passes.goal.time_limit_s, passes.goal.time_limit_s > 0)},
            {"predicted_passes", predicted},
            {"predicted_seconds", report::number(passes.predicted_seconds, passes.predicted_seconds > 0)}};
}

// What shares refer to: phases are measured by the clock, which runs on while others have the processor.
double thread_seconds(const RunStatistics& statistics) {
    double phases_s = 0.0;
    for (const integrate::PhaseCost& cost : statistics.counters.phases) phases_s += cost.seconds;
    return std::max({statistics.cpu_seconds, phases_s, 1e-9});
}

// The image function's phases, and `samples and film` for what it does not account for.
std::vector<std::pair<std::string, integrate::PhaseCost>> phases(const RunStatistics& statistics) {
    std::vector<std::pair<std::string, integrate::PhaseCost>> phases;
    double rest_s = thread_seconds(statistics);
    for (std::size_t i = 0; i < integrate::kPhases; ++i) {
        const integrate::PhaseCost& cost = statistics.counters.phases[i];
        if (cost.seconds == 0.0) continue;
        phases.emplace_back(integrate::name_of(static_cast<integrate::Phase>(i)), cost);
        rest_s -= cost.seconds;
    }
    phases.push_back({"samples and film", {.seconds = std::max(rest_s, 0.0)}});
    return phases;
}

report::Json phases_json(const RunStatistics& statistics) {
    report::Json json = report::Json::array();
    for (const auto& [name, cost] : phases(statistics)) {
        json.push_back({{"phase", name},
                        {"seconds", cost.seconds},
                        {"share", cost.seconds / thread_seconds(statistics)},
                        {"steps", cost.steps},
                        {"noise_evaluations", cost.noise_evaluations}});
        if (cost.left_out.total() == 0) continue;
        json.back()["octaves_left_out"] = {{"too_fine_for_the_step", cost.left_out.too_fine},
                                           {"sign_settled_without", cost.left_out.settled},
                                           {"in_a_window", cost.left_out.in_window}};
    }
    return json;
}

// A share of what all octaves at every point looked at would have been.
std::string left_out_summary(const integrate::Counters& counters) {
    trace::LeftOut left;
    for (const integrate::PhaseCost& cost : counters.phases) left += cost.left_out;
    const double all = static_cast<double>(left.total() + counters.noise_evaluations) * 0.01;
    if (left.total() == 0) return {};
    return fmt::format(
        "left out {:.0f} % of octaves: too fine for the step {:.0f} %, sign settled without {:.0f} %, in a window "
        "{:.0f} %\n",
        static_cast<double>(left.total()) / all, static_cast<double>(left.too_fine) / all,
        static_cast<double>(left.settled) / all, static_cast<double>(left.in_window) / all);
}

std::string phases_summary(const RunStatistics& statistics) {
    std::string text = "phases   ";
    const char* separator = "";
    for (const auto& [name, cost] : phases(statistics)) {
        text += fmt::format("{}{} {:.0f} %", separator, name, 100.0 * cost.seconds / thread_seconds(statistics));
        separator = ", ";
    }
    return text + "\n";
}

}  // namespace

RunStatistics collect(const strata::render::ProgressiveResult& result, const strata::render::PassGoal& goal,
                      const std::string& scene) {
    RunStatistics statistics = collect(result.render, scene);
    if (goal.passes > 1) {
        statistics.passes = PassStatistics{goal,         result.passes,           result.end,
                                           result.error, result.predicted_passes, result.predicted_seconds};
    }
    return statistics;
}

RunStatistics collect(const strata::render::RenderResult& result, const std::string& scene) {
    return {.counters = result.counters,
            .seconds = result.seconds,
            .cpu_seconds = result.cpu_seconds,
            .threads = result.threads,
            .simd_target = noise::simd_target(),
            .peak_memory_bytes = peak_memory(),
            .scene = scene,
            .settings_mark = {},
            .passes = {}};
}

std::string summary(const RunStatistics& statistics) {
    const integrate::Counters& c = statistics.counters;
    const double rays = static_cast<double>(c.rays), shadow_rays = static_cast<double>(c.shadow_rays);
    const double sky_rays = static_cast<double>(c.sky_rays), water_rays = static_cast<double>(c.water_rays);
    const double all_rays = rays + shadow_rays + sky_rays + water_rays;
    std::string with_sky = sky_rays > 0.0 ? fmt::format(", {} sky rays", report::scaled(sky_rays)) : std::string();
    if (water_rays > 0.0) with_sky += fmt::format(", {} from water", report::scaled(water_rays));
    std::string text = fmt::format("time     {} ({:.2f} s on {} thread{}, {:.2f} s of CPU, {})\n",
                                   cli::duration_text(statistics.seconds), statistics.seconds, statistics.threads,
                                   statistics.threads == 1 ? "" : "s", statistics.cpu_seconds, statistics.simd_target);
    text +=
        fmt::format("rays     {} and {} shadow rays{}, {}rays/s\n", report::scaled(rays), report::scaled(shadow_rays),
                    with_sky, report::scaled(all_rays / std::max(statistics.seconds, 1e-9)));
    if (c.noise_evaluations > 0) {
        text += fmt::format("noise    {:.1f} evaluations a ray, shadow rays and normals included in the count\n",
                            static_cast<double>(c.noise_evaluations) / std::max(1.0, all_rays));
    }
    text += left_out_summary(c);
    if (c.steps > 0) text += phases_summary(statistics);
    if (statistics.passes) text += passes_summary(*statistics.passes);
    text += fmt::format("memory   {:.0f} MB at most\n", static_cast<double>(statistics.peak_memory_bytes) / 1e6);
    return text;
}

std::string statistics_json(const RunStatistics& statistics) {
    report::Json json = {{"scene", statistics.scene},
                         {"version", STRATA_VERSION},
                         {"simd_target", statistics.simd_target},
                         {"threads", statistics.threads}};
    json.update(report::counts_json(statistics.counters));
    json.update({{"seconds", statistics.seconds},
                 {"cpu_seconds", statistics.cpu_seconds},
                 {"peak_memory_bytes", statistics.peak_memory_bytes},
                 {"phases", phases_json(statistics)}});
    if (!statistics.settings_mark.empty()) json["settings_mark"] = statistics.settings_mark;
    if (statistics.passes) json.update(passes_json(*statistics.passes));
    return report::text_of(json);
}

}  // namespace strata::tools::render
