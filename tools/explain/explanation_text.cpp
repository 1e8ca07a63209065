#include <fmt/format.h>

#include <algorithm>

#include "src/scene/enum_names.h"
#include "tools/cli/progress_printer.h"
#include "tools/explain/explanation.h"
#include "tools/report/table.h"
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

// Those that are left out for one reason share a line.
std::vector<Feature> told_features(const Plan& plan, bool needed) {
    std::vector<Feature> told;
    std::vector<std::string> others;
    for (const Feature& feature : plan.features) {
        if (feature.needed != needed) continue;
        const auto same = std::ranges::find(told, feature.why, &Feature::why);
        if (needed || same == told.end()) {
            told.push_back(feature);
            others.emplace_back();
        } else {
            std::string& names = others[static_cast<std::size_t>(same - told.begin())];
            names += (names.empty() ? "; so also " : ", ") + feature.name;
        }
    }
    for (std::size_t i = 0; i < told.size(); ++i) told[i].why += others[i];
    return told;
}

std::string features_text(const Plan& plan, bool needed, const char* heading) {
    report::Table table({heading, "why"});
    for (const Feature& feature : told_features(plan, needed)) table.add({"  " + feature.name, feature.why});
    return "\n" + table.text();
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
    report::Table table({">octave", ">amplitude", ">wavelength", ">a pixel wide at", ">below tolerance from", "role"});
    for (const OctavePlan& octave : plan.octaves) {
        table.add({fmt::format("{}", octave.octave), fmt::format("{:.3g}", octave.amplitude), length(octave.wavelength),
                   length(octave.pixel_wide_at),
                   octave.below_tolerance_from ? length(*octave.below_tolerance_from) : "-", roles_text(octave)});
    }
    return "\n" + table.text() + plan.octaves_note;
}

std::string relief_text(const Plan& plan) {
    if (plan.relief.empty()) return {};
    report::Table table({"relief", "type", "of", ">octaves", ">heights", ">slope", ">bend"});
    for (const ReliefRow& row : plan.relief) {
        const noise::Certificate& c = row.certificate;
        table.add({"  " + row.name, row.type, row.of, fmt::format("{}", row.octaves),
                   fmt::format("{:.4g} to {:.4g}", c.low, c.high), fmt::format("{:.3g}", c.slope),
                   fmt::format("{:.3g}", c.bend)});
    }
    return "\n" + table.text() +
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
    std::vector<std::string> headings{"cost", ">predicted", ">a ray", ">99 % sure: between"};
    if (beside) headings.insert(headings.end(), {">actual", ">predicted/actual"});
    report::Table table(headings);
    for (const NamedCost& cost : costs_of(explanation)) {
        const std::string name = cost.name;
        const bool counts = !name.ends_with("seconds") && !name.ends_with("bytes");
        std::vector<std::string> cells{
            name, value_text(name, cost.predicted),
            counts && cost.predicted ? fmt::format("{:.3g}", *cost.predicted / rays) : "",
            cost.between ? report::scaled(cost.between->low) + " and " + report::scaled(cost.between->high) : ""};
        const auto ratio = cost.ratio();
        if (beside) cells.push_back(value_text(name, cost.actual));
        if (beside) cells.push_back(ratio ? fmt::format("{:.2f}", *ratio) : "-");
        table.add(std::move(cells));
    }
    return "\n" + table.text();
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
    const Costs none;
    const bool beside = explanation.recorded.has_value();
    const Costs& a = beside ? explanation.recorded->costs : none;
    std::optional<double> actual_rays;
    if (beside) actual_rays = static_cast<double>(a.rays);
    std::vector<NamedCost> costs{{"rays", static_cast<double>(p.rays), actual_rays}};
    for (const auto& [name, count] : integrate::kCounters) {
        if (!is_predicted(count)) continue;
        costs.push_back({name, p.counts[count], a.counts[count], explanation.prediction.between[count]});
    }
    costs.insert(costs.end(), {{"cpu_seconds", p.cpu_seconds, a.cpu_seconds},
                               {"seconds", p.seconds, a.seconds},
                               {"peak_memory_bytes", p.peak_memory_bytes, a.peak_memory_bytes}});
    return costs;
}

std::string explanation_text(const Explanation& explanation) {
    return headline(explanation) + features_text(explanation.plan, true, "needed") +
           features_text(explanation.plan, false, "left out") + octaves_text(explanation.plan) +
           relief_text(explanation.plan) + costs_text(explanation) + basis_text(explanation);
}

}  // namespace strata::tools::explain
