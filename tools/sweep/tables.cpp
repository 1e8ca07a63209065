#include "tools/sweep/tables.h"

#include <fmt/format.h>

#include "noise/simd_target.h"
#include "src/scene/enum_names.h"
#include "src/scene/needs.h"
#include "tools/cli/text_file.h"
#include "tools/report/json.h"
#include "tools/report/table.h"

namespace strata::tools::sweep {

namespace {

using report::Json;
using report::number;

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

Json sweep_json(const Job& job, const job::Ledger& ledger, const Results& results) {
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
        const auto cost = job::find_cost(ledger, picture.file, picture.metadata);
        cells.push_back({{"file", picture.file},
                         {"row", job.cells[i].row},
                         {"column", job.cells[i].column},
                         {"settings", settings},
                         {"sampling", sampling_json(picture.scene.sampling)},
                         {"window", {w.x0, w.y0, w.x1, w.y1}},
                         {"cost", cost ? job::cost_json(*cost) : Json()},
                         {"error", error_json(job, results, i)}});
    }
    return {{"scene", job.loaded.name},
            {"version", STRATA_VERSION},
            {"simd_target", noise::simd_target()},
            {"rows", axis_json(job.axes.rows)},
            {"columns", axis_json(job.axes.columns)},
            {"references", references},
            {"cells", cells},
            {"costs", job::to_json(ledger)}};
}

// Empty where nothing is known.
Json csv_errors(const Job& job, const Results& results, std::size_t cell) {
    const auto& found = results.cells[cell];
    const image::Comparison c = found.value_or(image::Comparison{});
    const auto known = [&](double value) { return number(value, found.has_value()); };
    const bool has_reference = found && !job.references.empty();
    const auto reference = [&] { return results.reference_errors[job.cells[cell].reference]; };
    return {
        {"rmse", known(c.rmse)},
        {"rmse_r", known(c.channel_rmse[0])},
        {"rmse_g", known(c.channel_rmse[1])},
        {"rmse_b", known(c.channel_rmse[2])},
        {"relative_rmse", known(c.relative_rmse)},
        {"max_abs", known(c.max_abs)},
        {"percentile99", known(c.percentile99)},
        {"reference_own_rmse", has_reference ? number(reference()) : Json()},
        {"near_reference_error", has_reference ? Json(results.is_near_reference(job, cell) ? "yes" : "no") : Json()}};
}

std::string csv(const Job& job, const job::Ledger& ledger, const Results& results) {
    std::vector<Json> rows;
    for (std::size_t i = 0; i < job.cells.size(); ++i) {
        const Picture& picture = job.cells[i].picture;
        Json row = {{"file", picture.file}};
        for (const auto& [key, value] : job.cells[i].settings) row[key] = value;
        row["samples_a_pixel"] = scene::samples_a_pixel(picture.scene.sampling);
        const auto cost = job::find_cost(ledger, picture.file, picture.metadata);
        const Json costs = job::cost_json(cost.value_or(job::PictureCost{}));
        for (const auto& [name, value] : costs.items()) {
            if (name != "threads") row[name] = cost ? value : Json();
        }
        row.update(csv_errors(job, results, i));
        rows.push_back(std::move(row));
    }
    return report::csv_of(rows);
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

void write_costs(cli::PlannedFiles& files, const Job& job, const job::Ledger& ledger) {
    write_text(files, job.folder / kJsonFile, report::text_of({{"unfinished", true}, {"costs", job::to_json(ledger)}}));
}

void write_tables(cli::PlannedFiles& files, const Job& job, const job::Ledger& ledger, const Results& results) {
    write_text(files, job.folder / kCsvFile, csv(job, ledger, results));
    write_text(files, job.folder / kJsonFile, report::text_of(sweep_json(job, ledger, results)));
}

}  // namespace strata::tools::sweep
