#include "tools/sweep/tables.h"

#include <fmt/format.h>

#include <cmath>

#include "noise/simd_target.h"
#include "src/scene/enum_names.h"
#include "src/scene/needs.h"
#include "tools/cli/text_file.h"
#include "tools/report/csv.h"
#include "tools/report/json.h"

namespace strata::tools::sweep {

namespace {

using report::csv_cell;
using report::Json;

void write_text(cli::PlannedFiles& files, const std::filesystem::path& path, const std::string& text) {
    write_if_changed(files, path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

Json axis_json(const std::optional<Axis>& axis) {
    if (!axis) return nullptr;
    return {{"key", axis->key}, {"values", axis->values}};
}

// Without an antialiasing filter N and m have no part in the picture, but they say where the cell stands.
Json sampling_json(const scene::Sampling& sampling) {
    return {{"estimator", scene::name_of(sampling.estimator)},
            {"N", sampling.N},
            {"m", sampling.m},
            {"time_order", sampling.time_order},
            {"seed", sampling.seed}};
}

Json cost_json(const std::optional<PictureCost>& cost) {
    if (!cost) return nullptr;
    return {
        {"rays", cost->rays},       {"shadow_rays", cost->shadow_rays}, {"noise_evaluations", cost->noise_evaluations},
        {"seconds", cost->seconds}, {"cpu_seconds", cost->cpu_seconds}, {"threads", cost->threads}};
}

Json error_json(const Job& job, const Results& results, std::size_t cell) {
    if (!results.cells[cell]) return nullptr;
    const image::Comparison& c = *results.cells[cell];
    Json json = {{"reference",
                  job.references.empty() ? job.given_reference_name : job.references[job.cells[cell].reference].file},
                 {"rmse", c.rmse},
                 {"rmse_rgb", c.channel_rmse},
                 {"relative_rmse", c.relative_rmse},
                 {"max_abs", c.max_abs},
                 {"percentile99", c.percentile99},
                 {"not_finite", c.not_finite}};
    if (!job.references.empty()) json["near_reference_error"] = results.is_near_reference(job, cell);
    return json;
}

Json sweep_json(const Job& job, const Ledger& ledger, const Results& results) {
    Json references = Json::array();
    for (std::size_t r = 0; r < job.references.size(); ++r) {
        const Reference& reference = job.references[r];
        references.push_back({{"file", reference.file},
                              {"halves", {reference.halves[0].file, reference.halves[1].file}},
                              {"sampling", sampling_json(reference.halves[0].scene.sampling)},
                              {"second_seed", reference.halves[1].scene.sampling.seed},
                              {"own_rmse", results.reference_errors[r]}});
    }
    Json cells = Json::array();
    for (std::size_t i = 0; i < job.cells.size(); ++i) {
        const Picture& picture = job.cells[i].picture;
        const film::Rect& w = picture.window;
        Json settings = Json::object();
        for (const auto& [key, value] : job.cells[i].settings) settings[key] = value;
        cells.push_back({{"file", picture.file},
                         {"row", job.cells[i].row},
                         {"column", job.cells[i].column},
                         {"settings", settings},
                         {"sampling", sampling_json(picture.scene.sampling)},
                         {"window", {w.x0, w.y0, w.x1, w.y1}},
                         {"cost", cost_json(find_cost(ledger, picture.file, picture.metadata))},
                         {"error", error_json(job, results, i)}});
    }
    return {{"scene", job.loaded.name},
            {"version", STRATA_VERSION},
            {"simd_target", noise::simd_target()},
            {"rows", axis_json(job.axes.rows)},
            {"columns", axis_json(job.axes.columns)},
            {"references", references},
            {"cells", cells},
            {"costs", to_json(ledger)}};
}

std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

std::string csv_errors(const Job& job, const Results& results, std::size_t cell) {
    const auto& comparison = results.cells[cell];
    std::string line;
    if (!comparison) return ",,,,,,,,";
    const image::Comparison& c = *comparison;
    for (const double value :
         {c.rmse, c.channel_rmse[0], c.channel_rmse[1], c.channel_rmse[2], c.relative_rmse, c.max_abs, c.percentile99})
        line += fmt::format(",{}", csv_number(value));
    if (job.references.empty()) return fmt::format("{},,", line);
    return line + fmt::format(",{},{}", csv_number(results.reference_errors[job.cells[cell].reference]),
                              results.is_near_reference(job, cell) ? "yes" : "no");
}

std::string csv(const Job& job, const Ledger& ledger, const Results& results) {
    std::string text = "file";
    for (const auto& [key, value] : job.cells.front().settings) text += fmt::format(",{}", csv_cell(key));
    text +=
        ",samples_a_pixel,rays,shadow_rays,noise_evaluations,seconds,cpu_seconds,rmse,rmse_r,rmse_g,rmse_b,relative_"
        "rmse,max_abs,percentile99,reference_own_rmse,near_reference_error\n";
    for (std::size_t i = 0; i < job.cells.size(); ++i) {
        const Picture& picture = job.cells[i].picture;
        text += csv_cell(picture.file);
        for (const auto& [key, value] : job.cells[i].settings) text += fmt::format(",{}", csv_cell(value));
        text += fmt::format(",{}", scene::samples_a_pixel(picture.scene.sampling));
        const auto cost = find_cost(ledger, picture.file, picture.metadata);
        text += cost ? fmt::format(",{},{},{},{},{}", cost->rays, cost->shadow_rays, cost->noise_evaluations,
                                   cost->seconds, cost->cpu_seconds)
                     : ",,,,,";
        text += fmt::format("{}\n", csv_errors(job, results, i));
    }
    return text;
}

}  // namespace

void write_if_changed(cli::PlannedFiles& files, const std::filesystem::path& path,
                      std::span<const unsigned char> bytes) {
    std::string ignored;
    const auto present = cli::read_text_file(path, ignored);
    const std::string_view wanted(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const bool same = present && *present == wanted;
    if (!same) files.write_made(path, [&] { return bytes; });
}

void write_costs(cli::PlannedFiles& files, const Job& job, const Ledger& ledger) {
    write_text(files, job.folder / kJsonFile, report::text_of({{"unfinished", true}, {"costs", to_json(ledger)}}));
}

void write_tables(cli::PlannedFiles& files, const Job& job, const Ledger& ledger, const Results& results) {
    write_text(files, job.folder / kCsvFile, csv(job, ledger, results));
    write_text(files, job.folder / kJsonFile, report::text_of(sweep_json(job, ledger, results)));
}

}  // namespace strata::tools::sweep
