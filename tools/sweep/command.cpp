#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>

#include "src/parallel/cancel.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"
#include "tools/sweep/job.h"
#include "tools/sweep/render.h"
#include "tools/sweep/results.h"
#include "tools/sweep/sheet.h"
#include "tools/sweep/tables.h"

namespace strata::tools::sweep {

namespace {

// The options' texts; one that does not add up has its last.
struct AxisTexts {
    std::optional<std::string> N, m, estimator, time_order, seed, rows, columns;
    std::vector<std::string> axis;
};

AxisRequest axis_request(const AxisTexts& texts) {
    AxisRequest request;
    for (const auto& [origin, text] :
         {std::pair{"--N", &texts.N}, std::pair{"--m", &texts.m}, std::pair{"--estimator", &texts.estimator},
          std::pair{"--time-order", &texts.time_order}, std::pair{"--seed", &texts.seed}}) {
        if (*text) request.lists.push_back({origin, **text});
    }
    for (const std::string& text : texts.axis) request.anywhere.push_back({"--axis", text});
    if (texts.rows) request.rows.push_back({"--rows", *texts.rows});
    if (texts.columns) request.columns.push_back({"--columns", *texts.columns});
    return request;
}

void report(const SweepJob& job, const SweepResults& results) {
    std::string text;
    for (std::size_t r = 0; r < job.references.size(); ++r) {
        const SweepReference& reference = job.references[r];
        text += fmt::format("error    {} has an RMSE of about {:#.2g} itself\n", reference.file,
                            results.reference_errors[r]);
    }
    const std::string folder = job.folder.string();
    text += fmt::format("wrote    {}: {}, {}, {} and {} pictures\n", folder, kSheetFile, kCsvFile, kJsonFile,
                        job.cells.size());
    cli::print_out(text);
}

SweepLedger ledger_of(const SweepJob& job) {
    const std::filesystem::path file = job.folder / kJsonFile;
    const std::optional<SweepLedger> ledger = read_ledger(file);
    if (!ledger && !job.quiet) {
        cli::print_out(fmt::format("damaged  {}: it cannot be read; the times of pictures that are kept are lost\n",
                                   file.string()));
    }
    return ledger.value_or(SweepLedger{});
}

int sweep_command(const SweepRequest& request) {
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    const SweepJob job = prepare_sweep(request);
    SweepLedger ledger = ledger_of(job);
    cli::PlannedFiles files;
    for (const char* file : {kSheetFile, kCsvFile}) files.plan(job.folder / file);
    const SweepOutcome outcome = render_sweep(files, job, ledger, cancel);
    if (outcome.unresolved_rays > 0 && !job.quiet)
        cli::print_error(
            fmt::format("warning: {} rays were not settled; drawn in magenta, or as shadow", outcome.unresolved_rays));
    if (outcome.cancelled) {
        if (!job.quiet)
            cli::print_out(fmt::format("stopped  with {} of {} pictures; the same command goes on from there\n",
                                       outcome.kept + outcome.rendered, job.cells.size() + 2 * job.references.size()));
        return cli::kExitSignal + parallel::cancelling_signal();
    }
    if (outcome.failed > 0) {
        cli::print_error(fmt::format("{} of {} pictures are there; the same command goes on from there",
                                     outcome.kept + outcome.rendered, job.cells.size() + 2 * job.references.size()));
        return cli::kExitRuntime;
    }
    const SweepResults results = evaluate_sweep(files, job);
    write_tables(files, job, ledger, results);
    const std::filesystem::path sheet = job.folder / kSheetFile;
    write_if_changed(files, sheet, image::encode_canvas(sheet, draw_sheet(job, results), sheet_metadata(job)));
    if (!job.quiet && files.all_written()) report(job, results);
    if (!files.all_written()) return cli::kExitRuntime;
    return parallel::cancelling_signal() != 0 ? cli::kExitSignal + parallel::cancelling_signal() : 0;
}

void add_axis_options(cli::Command& command, AxisTexts& texts) {
    const auto add = [&](const char* names, std::optional<std::string>& text, const char* type, const char* meaning) {
        command.add_option(names, text, meaning)->type_name(type);
    };
    add("-N,--N", texts.N, "N,...", "Samples a side, as 1,2,3,10: the columns");
    add("-m,--m", texts.m, "M,...", "Orders of the B-spline filter, as 1,4,15: the rows");
    add("--estimator", texts.estimator, "NAME,...", "Estimators, as none,stratified,sobol");
    add("--time-order", texts.time_order, "L,...", "Orders of the B-spline filter in time");
    add("--seed", texts.seed, "S,...", "Seeds of the sample positions");
    command.add_option("--axis", texts.axis, "Any scene key, as octaves=2,4,8 (may be repeated)")
        ->type_name("KEY=V,...")
        ->repeated();
    add("--rows", texts.rows, "KEY=V,...", "The same, as rows");
    add("--columns", texts.columns, "KEY=V,...", "The same, as columns");
}

}  // namespace

void add_command(cli::Command& program, int& exit_code) {
    cli::Command* command =
        program.add_subcommand("sweep", "Render a scene over a grid of settings and measure the errors");
    auto request = std::make_shared<SweepRequest>();
    auto texts = std::make_shared<AxisTexts>();
    static constexpr std::array<std::string_view, 5> kOwn{"sampling.N", "sampling.m", "sampling.estimator",
                                                          "sampling.time_order", "sampling.seed"};
    request->scene.add_to(*command, "SCENE", kOwn);
    add_axis_options(*command, *texts);
    command->add_option("--crop", request->crop, "Render pixels [x0,x1) x [y0,y1) of the frame alone, y down")
        ->type_name("x0,y0,x1,y1");
    command
        ->add_option("--reference", request->reference,
                     "What errors are measured against: auto, none, or a picture of the same size")
        ->type_name("auto|none|FILE")
        ->capture_default_str();
    command
        ->add_option("--reference-N", request->reference_N,
                     "N of each half of the automatic reference, 1 to 64; default twice the sweep's largest N")
        ->type_name("N");
    command->add_option("-o,--output", request->output, "The folder to write to; default SCENE-sweep")
        ->type_name("FOLDER");
    command->add_option("--threads", request->threads, "Threads, up to 1024; 0: as many as machine and container give")
        ->type_name("n")
        ->capture_default_str();
    command->add_option("--simd", request->simd, "avx512, avx2, sse4 or scalar; default the best that is here")
        ->type_name("TARGET");
    command->add_flag("--quiet", request->quiet, "No progress, summary or warnings");
    command->footer(
        "One or two axes may have several values, at most 100 each and 400 pictures in all; others have one.\n"
        "The folder gets each picture as float EXR (N02_m04.exr), sweep.png, a labelled contact sheet, and sweep.csv\n"
        "and sweep.json with settings, rays, times and errors. Pictures of the same scene and settings that are there\n"
        "already, whole, are kept, with their times; damaged ones and others of their names are replaced.\n"
        "Automatic reference: two shared-sobol pictures of different seeds, reference_*_a.exr and _b.exr, and their "
        "mean; "
        "one\n"
        "for each filter and scene, since another order m (or any key but N, estimator, seed and colours) has "
        "another\n"
        "ideal picture; `super` is held against order 1, `none` against the filter of its row. The reference's own\n"
        "RMSE is half that between its halves; errors within 3 times of it are marked *.\n"
        "  strata sweep terrain --size 320x180 --N 1,2,3,10 --m 1,4,15 -o sweep\n"
        "  strata sweep wheel --rows seed=1,2,3 --columns estimator=stratified,sobol --reference none\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->callback([request, texts, &exit_code] {
        request->axes = axis_request(*texts);
        exit_code = sweep_command(*request);
    });
}

}  // namespace strata::tools::sweep
