#include <fmt/format.h>

#include "noise/simd_target.h"
#include "src/scene/enum_names.h"
#include "tools/bench/report.h"
#include "tools/cli/shared_options.h"
#include "tools/report/folder.h"
#include "tools/report/json.h"
#include "tools/report/machine.h"

namespace strata::tools::bench {

namespace {

using report::Json;
using report::number;

Json phases_json(const Measurement& m) {
    double total = 0;
    for (const Phase& phase : m.phases) total += phase.seconds;
    Json phases = Json::array();
    for (const Phase& phase : m.phases) {
        phases.push_back({{"name", phase.name},
                          {"share", number(total > 0 ? phase.seconds / total : 0)},
                          {"steps_per_ray", number(static_cast<double>(phase.steps) / m.rays())},
                          {"evaluations_per_ray", number(static_cast<double>(phase.noise_evaluations) / m.rays())}});
    }
    return phases;
}

Json case_json(const Measurement& m) {
    const scene::Scene& scene = m.what.scene;
    Json json = {{"id", m.what.id()},
                 {"mark", m.what.mark()},
                 {"scene", m.what.scene_name},
                 {"width", scene.film.width},
                 {"height", scene.film.height},
                 {"N", scene.sampling.N},
                 {"estimator", scene::name_of(scene.sampling.estimator)},
                 {"octaves", scene.surface.octaves},
                 {"tracer", cli::name_of(m.what.tracer)},
                 {"threads", m.what.threads},
                 {"pixels", m.what.subset.pixels()},
                 {"part", m.what.subset.text()}};
    json.update(report::counts_json(m.counters));
    json.update({{"evaluations_per_ray", number(m.evaluations_a_ray())},
                 {"steps_per_ray", number(m.steps_a_ray())},
                 {"ns_per_ray", number(m.ns_a_ray(Pick::least))},
                 {"ns_per_ray_median", number(m.ns_a_ray(Pick::median))},
                 {"ns_per_evaluation", number(m.ns_an_evaluation(Pick::least))},
                 {"cpu_s", m.cpu_s},
                 {"wall_s", m.wall_s},
                 {"phases", phases_json(m)}});
    return json;
}

Json figures_json(const std::vector<Figure>& figures) {
    Json rows = Json::array();
    for (const Figure& figure : figures) {
        rows.push_back({{"name", figure.name},
                        {"meaning", figure.meaning},
                        {"value", number(figure.value)},
                        {"of_medians", number(figure.of_medians)},
                        {"floor", figure.floor},
                        {"aim", number(figure.aim)},
                        {"more_is_better", figure.more_is_better},
                        {"verdict", verdict_name(figure.verdict())},
                        {"note", figure.note}});
    }
    return rows;
}

Json curves_json(const Results& results) {
    Json curves = Json::array();
    for (const Curve& curve : results.plan.curves) {
        Json points = Json::array();
        for (const CurvePoint& point : curve.points) points.push_back({{"x", point.x}, {"case", point.id}});
        curves.push_back({{"against", curve.axis}, {"name", curve.name}, {"points", points}});
    }
    return curves;
}

Json peers_json(const Results& results) {
    Json peers = Json::array();
    for (const PeerResult& peer : results.peers) {
        Json facts = Json::object();
        for (const auto& [name, value] : peer.facts) facts[name] = number(value);
        peers.push_back({{"id", peer.id},
                         {"what", peer.what},
                         {"ns_per_ray", number(pick_of(peer.ns_a_ray, Pick::least))},
                         {"ns_per_ray_median", number(pick_of(peer.ns_a_ray, Pick::median))},
                         {"rounds_ns_per_ray", peer.ns_a_ray},
                         {"facts", facts}});
    }
    return peers;
}

Json memory_json(const Results& results) {
    Json rows = Json::array();
    for (const MemoryResult& row : results.memory) {
        rows.push_back({{"id", row.id},
                        {"width", row.width},
                        {"height", row.height},
                        {"peak_memory_bytes", row.peak_bytes > 0 ? Json(row.peak_bytes) : Json(nullptr)},
                        {"seconds", number(row.seconds)},
                        {"failure", row.failure}});
    }
    return rows;
}

Json light_json(const Results& results) {
    Json rows = Json::array();
    for (const FeaturePair& pair : results.plan.light) {
        const Measurement *off = find(results.measurements, pair.off), *on = find(results.measurements, pair.on);
        if (off == nullptr || on == nullptr) continue;
        rows.push_back({{"name", pair.name},
                        {"case_off", pair.off},
                        {"case_on", pair.on},
                        {"rays_per_sample_off", off->rays_a_sample()},
                        {"rays_per_sample_on", on->rays_a_sample()},
                        {"ns_per_ray_ratio", on->ns_a_ray(Pick::least) / off->ns_a_ray(Pick::least)}});
    }
    return rows;
}

Json against_json(const std::vector<Comparison>& earlier) {
    Json rows = Json::array();
    for (const Comparison& row : earlier) {
        rows.push_back({{"id", row.id},
                        {"ns_per_ray_ratio", number(row.time_ratio)},
                        {"ns_per_ray_median_ratio", number(row.median_ratio)},
                        {"evaluations_per_ray_ratio", number(row.evaluations_ratio)}});
    }
    return rows;
}

}  // namespace

std::string json_report(const Results& results, const std::vector<Figure>& figures,
                        const std::vector<Comparison>& earlier) {
    Json cases = Json::array();
    for (const Measurement& m : results.measurements) {
        if (!m.cpu_s.empty()) cases.push_back(case_json(m));
    }
    const PlanSettings& settings = results.plan.settings;
    Json json{{"kind", "strata bench"},
              {"format", kFormat},
              {"version", STRATA_VERSION},
              {"machine", {{"processor", report::processor_name()}, {"simd_target", noise::simd_target()}}},
              {"rounds", results.rounds},
              {"quick", settings.quick},
              {"whole", settings.whole},
              {"rays", settings.rays ? Json(*settings.rays) : Json(nullptr)},
              {"figures", figures_json(figures)},
              {"cases", cases},
              {"curves", curves_json(results)},
              {"peers", peers_json(results)},
              {"light", light_json(results)},
              {"memory", memory_json(results)}};
    if (!earlier.empty()) json["against"] = against_json(earlier);
    return report::text_of(json);
}

std::vector<std::filesystem::path> report_files(const std::filesystem::path& folder) {
    return {folder / "bench.json", folder / "bench.txt", folder / "bench.png", folder / "bench.svg"};
}

void write_report(const std::filesystem::path& folder, const Results& results, const std::vector<Figure>& figures,
                  const std::vector<Comparison>& earlier, cli::PlannedFiles& files) {
    files.write(folder / "bench.json", json_report(results, figures, earlier));
    files.write(folder / "bench.txt", text_report(results, figures, earlier));
    report::write_plots(plot_report(results), folder, "bench", files);
}

}  // namespace strata::tools::bench
