#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/sweep/job.h"
#include "tools/sweep/results.h"
#include "tools/sweep/sheet.h"
#include "tools/sweep/tables.h"

namespace strata::tools::sweep {

namespace {

void report(const Job& job, const Results& results) {
    std::string text;
    for (std::size_t r = 0; r < job.references.size(); ++r) {
        const Reference& reference = job.references[r];
        text += fmt::format("error    {} has an RMSE of about {:#.2g} itself\n", reference.file,
                            results.reference_errors[r]);
    }
    const std::string folder = job.folder.string();
    text += fmt::format("wrote    {}: {}, {}, {} and {} pictures\n", folder, kSheetFile, kCsvFile, kJsonFile,
                        job.cells.size());
    cli::print_out(text);
}

std::vector<const Picture*> pictures_of(const Job& job) {
    std::vector<const Picture*> pictures;
    for (const Cell& cell : job.cells) pictures.push_back(&cell.picture);
    for (const Reference& reference : job.references)
        for (const Picture& half : reference.halves) pictures.push_back(&half);
    return pictures;
}

int sweep_command(const Request& request) {
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    const Job job = prepare_sweep(request);
    job::Ledger ledger = job::ledger_of(job.folder / kJsonFile, job.quiet);
    cli::PlannedFiles files;
    for (const char* file : {kSheetFile, kCsvFile}) files.plan(job.folder / file);
    const std::vector<const Picture*> pictures = pictures_of(job);
    const job::Outcome outcome = job::render_missing(
        {job.folder, job.threads, job.quiet}, pictures, ledger, [&] { write_costs(files, job, ledger); }, cancel);
    if (!outcome.is_whole(pictures.size(), job.quiet))
        return outcome.cancelled ? cli::exit_code_of(true) : cli::kExitRuntime;
    const Results results = evaluate_sweep(files, job);
    write_tables(files, job, ledger, results);
    const std::filesystem::path sheet = job.folder / kSheetFile;
    write_if_changed(files, sheet, image::encode_canvas(sheet, draw_sheet(job, results), sheet_metadata(job)));
    if (!job.quiet && files.all_written()) report(job, results);
    return cli::exit_code_of(files.all_written());
}

void add_axis_options(cli::Command& command, AxisRequest& request) {
    const auto list = [&command](const char* names, std::vector<AxisOption>& options, const char* origin,
                                 const char* type, const char* meaning) {
        const auto read = [&options, origin](const std::string& text) { options.push_back({origin, text}); };
        return command.add_option(names, read, type, meaning);
    };
    for (const AxisName& name : kAxisNames) list(name.names, request.lists, name.option, name.type, name.meaning);
    list("--axis", request.anywhere, "--axis", "KEY=V,...", "Any scene key, as octaves=2,4,8 (may be repeated)")
        ->repeated();
    list("--rows", request.rows, "--rows", "KEY=V,...", "The same, as rows");
    list("--columns", request.columns, "--columns", "KEY=V,...", "The same, as columns");
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command =
        program.add_subcommand("sweep", "Render a scene over a grid of settings and measure the errors");
    auto request = std::make_shared<Request>();
    std::vector<std::string_view> own;
    for (const AxisName& name : kAxisNames) own.emplace_back(name.key);
    request->scene.add_to(*command, "SCENE", own);
    add_axis_options(*command, request->axes);
    cli::add_crop(*command, request->crop);
    command
        ->add_option("--reference", request->reference, "auto|none|FILE",
                     "What errors are measured against: auto, none, or a picture of the same size")
        ->capture_default_str();
    command->add_option("--reference-N", request->reference_N, 1, kMostN, "N",
                        "N of each half of the automatic reference, 1 to 64; default twice the sweep's largest N");
    command->add_option("-o,--output", request->output, "FOLDER", "The folder to write to; default SCENE-sweep");
    cli::add_threads(*command, request->threads);
    cli::add_simd(*command);
    cli::add_quiet(*command, request->quiet);
    command->footer(
        "One or two axes may have several values, at most 100 each and 400 pictures in all; others have one.\n"
        "The folder gets each picture as float EXR (N02_m04.exr), sweep.png, a labelled contact sheet, and sweep.csv\n"
        "and sweep.json with settings, rays, times and errors. Pictures of the same scene and settings that are there\n"
        "already, whole, are kept, with their times; damaged ones and others of their names are replaced.\n"
        "Automatic reference: two shared-sobol pictures of different seeds, reference_*_a.exr and _b.exr, and their "
        "mean; one\n"
        "for each filter and scene, since another order m (or any key but N, estimator, seed and colours) has another\n"
        "ideal picture; `super` is held against order 1, `none` against the filter of its row. The reference's own\n"
        "RMSE is half that between its halves; errors within 3 times of it are marked *.\n"
        "  strata sweep hills --size 320x180 --N 1,2,3,10 --m 1,4,15 -o sweep\n"
        "  strata sweep wheel --rows seed=1,2,3 --columns estimator=stratified,sobol --reference none\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->action([request] { return sweep_command(*request); });
}

}  // namespace strata::tools::sweep
