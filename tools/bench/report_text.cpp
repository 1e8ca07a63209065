#include <fmt/format.h>

#include "noise/simd_target.h"
#include "tools/bench/report.h"
#include "tools/report/machine.h"
#include "tools/report/table.h"
#include "tools/report/text.h"

namespace strata::tools::bench {

namespace {

std::string share_text(const Measurement& m) {
    double total = 0;
    for (const Phase& phase : m.phases) total += phase.seconds;
    std::string text;
    if (total <= 0) return text;
    for (const Phase& phase : m.phases) {
        const double share = 100 * phase.seconds / total;
        if (share >= 0.5) text += fmt::format("{}{} {:.0f}", text.empty() ? "" : ", ", phase.name, share);
    }
    return text;
}

std::string number_text(double value) { return fmt::format("{:.4g}", value); }

std::string cases_table(const Results& results) {
    if (results.measurements.empty()) return "";
    report::Table table({"case", ">rays", ">ns/ray", ">median", ">evals/ray", ">steps/ray", ">ns/eval", "time / %"});
    for (const Measurement& m : results.measurements) {
        table.add({m.what.id(), report::scaled(m.rays()), number_text(m.ns_a_ray(Pick::least)),
                   number_text(m.ns_a_ray(Pick::median)), number_text(m.evaluations_a_ray()),
                   number_text(m.steps_a_ray()), fmt::format("{:.3g}", m.ns_an_evaluation(Pick::least)),
                   share_text(m)});
    }
    return table.text() + "\n";
}

std::string subset_table(const Results& results) {
    std::string text;
    for (const SubsetPair& pair : results.plan.subset_pairs) {
        const Measurement *part = find(results.measurements, pair.part),
                          *whole = find(results.measurements, pair.whole);
        if (part == nullptr || whole == nullptr) continue;
        text += fmt::format("  {}: {:+.2f} % evaluations a ray, {:+.1f} % ns a ray ({})\n", pair.part,
                            100 * (part->evaluations_a_ray() / whole->evaluations_a_ray() - 1),
                            100 * (part->ns_a_ray(Pick::least) / whole->ns_a_ray(Pick::least) - 1),
                            part->what.subset.text());
    }
    return text.empty() ? text : "The blocks against the whole frame:\n" + text + "\n";
}

// Of what a feature adds to a sample.
std::string light_table(const Results& results) {
    if (results.plan.light.empty()) return "";
    report::Table table({"light, of a sample", ">rays", ">evals off", ">on", ">ns off", ">on", ">on/off"});
    for (const FeaturePair& pair : results.plan.light) {
        const Measurement *off = find(results.measurements, pair.off), *on = find(results.measurements, pair.on);
        if (off == nullptr || on == nullptr) continue;
        const double ns_off = off->ns_a_ray(Pick::least), ns_on = on->ns_a_ray(Pick::least);
        table.add({pair.name, fmt::format("{:+.2f}", on->rays_a_sample() - off->rays_a_sample()),
                   number_text(off->evaluations_a_ray()), number_text(on->evaluations_a_ray()), number_text(ns_off),
                   number_text(ns_on), fmt::format("{:.2f}", ns_on / ns_off)});
    }
    return table.text() + "\n";
}

std::string peers_table(const Results& results) {
    std::string text;
    for (const PeerResult& peer : results.peers) {
        text += fmt::format("  {:<26} {:>9.4g} ns/ray  (median {:.4g})  {}\n", peer.id,
                            pick_of(peer.ns_a_ray, Pick::least), pick_of(peer.ns_a_ray, Pick::median), peer.what);
        for (const auto& [name, value] : peer.facts) text += fmt::format("  {:<26}   {}: {:.4g}\n", "", name, value);
    }
    for (const std::string& missing : results.missing_peers) text += fmt::format("  {}\n", missing);
    return text.empty() ? text : "Peers:\n" + text + "\n";
}

std::string memory_table(const Results& results) {
    std::string text;
    for (const MemoryResult& row : results.memory) {
        if (row.peak_bytes > 0) {
            text += fmt::format("  {:<12} {:>6.0f} MB in {:.1f} s\n", row.id, static_cast<double>(row.peak_bytes) / 1e6,
                                row.seconds);
        } else {
            text += fmt::format("  {:<12} failed: {}\n", row.id, row.failure);
        }
    }
    return text.empty() ? text : "Memory of whole renders:\n" + text + "\n";
}

std::string figures_table(const Results& results, const std::vector<Figure>& figures) {
    report::Table table({"figure", ">value", ">medians", ">floor", ">aim", "", ""});
    std::string missing;
    for (const Figure& figure : figures) {
        if (!figure.value) {
            missing += fmt::format("{}{} ({})", missing.empty() ? "" : ", ", figure.name, figure.note);
            continue;
        }
        table.add({figure.name, figure.text(*figure.value), figure.of_medians ? figure.text(*figure.of_medians) : "",
                   figure.text(figure.floor), figure.aim ? figure.text(*figure.aim) : "",
                   verdict_name(figure.verdict()),
                   figure.meaning + (figure.note.empty() ? "" : fmt::format(" ({})", figure.note))});
    }
    std::string text = table.text();
    if (!missing.empty()) text += fmt::format("Not measured: {}\n", missing);
    const PlanSettings& settings = results.plan.settings;
    if (settings.quick || settings.rays)
        text += "Made with --quick or --rays: these are not the figures of whole frames.\n";
    return text;
}

std::string comparison_table(const std::vector<Comparison>& earlier) {
    if (earlier.empty()) return "";
    report::Table table({"now over then", ">ns/ray", ">median", ">evals/ray"});
    const auto ratio = [](double value) { return fmt::format("{:.3f}", value); };
    for (const Comparison& row : earlier) {
        table.add({row.id, ratio(row.time_ratio), ratio(row.median_ratio), ratio(row.evaluations_ratio)});
    }
    const Overall all = overall(earlier);
    if (all.fast) table.add({"geometric mean", ratio(*all.fast)});
    if (all.fast && all.reference) {
        table.add({"the same over the reference tracer's, for the machine", ratio(*all.fast / *all.reference)});
    }
    return "\n" + table.text();
}

}  // namespace

std::string text_report(const Results& results, const std::vector<Figure>& figures,
                        const std::vector<Comparison>& earlier) {
    std::string text =
        fmt::format("{}, {}; CPU time, least and median of {} round{}; one thread unless said\n\n",
                    report::processor_name(), noise::simd_target(), results.rounds, results.rounds == 1 ? "" : "s");
    text += cases_table(results) + light_table(results) + subset_table(results) + peers_table(results) +
            memory_table(results);
    return text + figures_table(results, figures) + comparison_table(earlier);
}

}  // namespace strata::tools::bench
