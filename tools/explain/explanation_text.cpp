#include <fmt/format.h>

#include "src/scene/enum_names.h"
#include "tools/cli/progress_printer.h"
#include "tools/explain/explanation.h"
#include "tools/report/text.h"

namespace strata::tools::explain {

namespace {

// Three digits, but no exponent for what is read as a length.
std::string length(double x) {
    if (x >= 99.95 && x < 1e6) return fmt::format("{:.0f}", x);
    return fmt::format("{:.3g}", x);
}

std::string headline(const Explanation& explanation) {
    const scene::Sampling& sampling = explanation.scene.sampling;
    const scene::Film& film = explanation.scene.film;
    const film::Rect& w = explanation.window;
    const int threads = explanation.prediction.threads;
    std::string text = fmt::format("{}  {}x{}", explanation.name, film.width, film.height);
    if (w != film::Rect{0, 0, film.width, film.height}) {
        text += fmt::format(", crop {},{},{},{}", w.x0, w.y0, w.x1, w.y1);
    }
    const bool single = scene::row_of(sampling.estimator).is_single;
    return text + fmt::format(", {}{}, {} tracer, {}, {} thread{}\n", scene::name_of(sampling.estimator),
                              single ? "" : fmt::format(" N = {} m = {}", sampling.N, sampling.m), explanation.tracer,
                              explanation.simd_target, threads, threads == 1 ? "" : "s");
}

std::string features_text(const Plan& plan, bool needed, const char* heading) {
    std::string text = fmt::format("\n{:<17}why\n", heading);
    for (const Feature& feature : plan.features) {
        if (feature.needed == needed) text += fmt::format("  {:<15}{}\n", feature.name, feature.why);
    }
    return text;
}

// One role for all distances, or each with where it begins.
std::string roles_text(const OctavePlan& octave) {
    if (octave.roles.size() == 1) return octave.roles.front().role;
    std::string text;
    for (const OctaveRole& role : octave.roles) {
        text += fmt::format("{}{} from {}", text.empty() ? "" : ", ", role.role, length(role.from));
    }
    return text;
}

std::string octaves_text(const Plan& plan) {
    if (plan.octaves.empty()) return {};
    std::string text = fmt::format("\n{:<8}{:>11}{:>12}{:>18}{:>23}  {}\n", "octave", "amplitude", "wavelength",
                                   "a pixel wide at", "below tolerance from", "role");
    for (const OctavePlan& octave : plan.octaves) {
        text +=
            fmt::format("{:>4}    {:>11.3g}{:>12}{:>18}{:>23}  {}\n", octave.octave, octave.amplitude,
                        length(octave.wavelength), length(octave.pixel_wide_at),
                        octave.below_tolerance_from ? length(*octave.below_tolerance_from) : "-", roles_text(octave));
    }
    return text + plan.octaves_note;
}

std::string relief_text(const Plan& plan) {
    if (plan.relief.empty()) return {};
    std::string text = fmt::format("\n{:<16}{:<10}{:<20}{:>9}{:>22}{:>9}{:>11}\n", "relief", "type", "of", "octaves",
                                   "heights", "slope", "bend");
    for (const ReliefRow& row : plan.relief) {
        const noise::Certificate& c = row.certificate;
        text += fmt::format("  {:<14}{:<10}{:<20}{:>9}{:>22}{:>9.3g}{:>11.3g}\n", row.name, row.type, row.of,
                            row.octaves, fmt::format("{:.4g} to {:.4g}", c.low, c.high), c.slope, c.bend);
    }
    return text +
           "Bounds of each term everywhere, in surface units: no height, slope or change of slope exceeds them.\n";
}

std::string value_text(const std::string& name, const std::optional<double>& value) {
    if (!value) return "-";
    if (name.ends_with("bytes")) return fmt::format("{:.0f} MB", *value / 1e6);
    if (name.ends_with("seconds")) return *value < 600 ? fmt::format("{:.3g} s", *value) : cli::duration_text(*value);
    return report::scaled(*value);
}

std::string costs_text(const Explanation& explanation) {
    const bool beside = explanation.recorded.has_value();
    const double rays = static_cast<double>(explanation.prediction.costs.rays);
    std::string text = fmt::format("\n{:<20}{:>12}{:>10}{:>22}", "cost", "predicted", "a ray", "99 % sure: between");
    if (beside) text += fmt::format("{:>12}{:>20}", "actual", "predicted/actual");
    text += "\n";
    for (const NamedCost& cost : costs_of(explanation)) {
        const std::string name = cost.name;
        const bool counts = !name.ends_with("seconds") && !name.ends_with("bytes");
        const std::string a_ray = counts && cost.predicted ? fmt::format("{:.3g}", *cost.predicted / rays) : "";
        const std::string between =
            cost.between ? report::scaled(cost.between->low) + " and " + report::scaled(cost.between->high)
                         : std::string();
        text += fmt::format("{:<20}{:>12}{:>10}{:>22}", name, value_text(name, cost.predicted), a_ray, between);
        if (beside) {
            const auto ratio = cost.ratio();
            text +=
                fmt::format("{:>12}{:>20}", value_text(name, cost.actual), ratio ? fmt::format("{:.2f}", *ratio) : "-");
        }
        text += "\n";
    }
    return text;
}

std::string basis_text(const Explanation& explanation) {
    const Prediction& prediction = explanation.prediction;
    std::string text;
    if (prediction.pilot) {
        const double rays = static_cast<double>(prediction.pilot->rays);
        const double share = rays / static_cast<double>(prediction.costs.rays);
        text = fmt::format(
            "From a pilot of {} rays, {:.3g} % of all{}. Rays are exact.\n", report::scaled(rays), 100 * share,
            share > kPilotFraction ? fmt::format(" (of a small picture some {} rays)", kLeastPilotRays) : "");
    } else {
        text = "No pilot: only what is known without one.\n";
    }
    if (explanation.recorded) {
        const Recorded& recorded = *explanation.recorded;
        text += fmt::format("Actual: {} thread{}, {}", recorded.threads, recorded.threads == 1 ? "" : "s",
                            recorded.simd_target);
        if (recorded.passes > 1) text += fmt::format(", one of {} passes", recorded.passes);
        text += ".\n";
    }
    return text;
}

}  // namespace

std::optional<double> NamedCost::ratio() const {
    if (!predicted || !actual || !(*predicted > 0.0) || !(*actual > 0.0)) return std::nullopt;
    return *predicted / *actual;
}

std::vector<NamedCost> costs_of(const Explanation& explanation) {
    const Costs& p = explanation.prediction.costs;
    const CountsBetween& between = explanation.prediction.between;
    const Costs none;
    const bool beside = explanation.recorded.has_value();
    const Costs& a = beside ? explanation.recorded->costs : none;
    std::optional<double> actual_rays;
    if (beside) actual_rays = static_cast<double>(a.rays);
    return {{"rays", static_cast<double>(p.rays), actual_rays},
            {"shadow_rays", p.shadow_rays, a.shadow_rays, between.shadow_rays},
            {"hits", p.hits, a.hits, between.hits},
            {"noise_evaluations", p.noise_evaluations, a.noise_evaluations, between.noise_evaluations},
            {"executed_lanes", p.executed_lanes, a.executed_lanes, between.executed_lanes},
            {"steps", p.steps, a.steps, between.steps},
            {"cpu_seconds", p.cpu_seconds, a.cpu_seconds},
            {"seconds", p.seconds, a.seconds},
            {"peak_memory_bytes", p.peak_memory_bytes, a.peak_memory_bytes}};
}

std::string explanation_text(const Explanation& explanation) {
    return headline(explanation) + features_text(explanation.plan, true, "needed") +
           features_text(explanation.plan, false, "left out") + octaves_text(explanation.plan) +
           relief_text(explanation.plan) + costs_text(explanation) + basis_text(explanation);
}

}  // namespace strata::tools::explain
