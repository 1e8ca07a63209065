#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <memory>

#include "src/integrate/make_image.h"
#include "src/scene/key_text.h"
#include "src/scene/typed_number.h"
#include "tools/cli/command_line.h"
#include "tools/cli/duration.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/job/batch.h"
#include "tools/job/settings_mark.h"
#include "tools/render/job.h"
#include "tools/render/journal.h"
#include "tools/render/outputs.h"
#include "tools/render/statistics.h"

namespace strata::tools::render {

namespace {

constexpr int kLargestTile = 1024;  // progress and the prediction of the time come by the tile

// Of one pass the metadata tell no number.
image::Metadata metadata_of(const Job& job, const strata::render::ProgressiveResult& result) {
    return final_metadata(job, result.passes, result.render.cancelled);
}

bool finish(PictureOutputs& outputs, const Job& job, const strata::render::ProgressiveResult& result) {
    return result.render.cancelled ? outputs.finish_partial(metadata_of(job, result)) : outputs.finish();
}

struct Rendered {
    strata::render::ProgressiveResult result;
    bool all_written = true;
};

// Called between the last ray and the end of the files.
using TellEnd = std::function<void(const strata::render::ProgressiveResult&)>;

// One pass goes into its files while it is rendered.
Rendered render_streamed(const Job& job, PictureOutputs& outputs, const strata::render::RenderOptions& options,
                         parallel::CancelToken& cancel, const TellEnd& tell_end) {
    const auto image = integrate::make_image(job.picture.scene, job.picture.tracer);
    const estimate::Estimator estimator(estimate::estimator_settings(job.picture.scene));
    outputs.begin(job.metadata);
    Rendered rendered;
    strata::render::ProgressiveResult& result = rendered.result;
    result.render = strata::render::render_strips(*image, estimator, job.rendered_window(), options, image::kStripRows,
                                                  [&](const film::Film& strip) {
                                                      outputs.write(strip);
                                                      if (!outputs.any())
                                                          cancel.request();  // nothing is left to render for
                                                  });
    result.passes = result.render.cancelled ? 0 : 1;
    result.end = result.render.cancelled ? strata::render::PassesEnd::cancelled : strata::render::PassesEnd::passes;
    tell_end(result);
    rendered.all_written = finish(outputs, job, result);
    return rendered;
}

// The mean of several passes is known at their end.
Rendered render_in_passes(const Job& job, PictureOutputs& outputs, const strata::render::RenderOptions& options,
                          strata::render::PassKeeper* keeper, const TellEnd& tell_end) {
    const auto image = integrate::make_image(job.picture.scene, job.picture.tracer);
    Rendered rendered;
    strata::render::ProgressiveResult& result = rendered.result;
    result = strata::render::render_progressively(*image, estimate::estimator_settings(job.picture.scene),
                                                  job.rendered_window(), job.goal, options, keeper);
    tell_end(result);
    outputs.begin_late(metadata_of(job, result));
    outputs.write_whole(result.render.film);
    rendered.all_written = finish(outputs, job, result);
    return rendered;
}

std::string stopped_line(const Job& job, const strata::render::ProgressiveResult& result) {
    if (result.passes > 0) return fmt::format("stopped  with {} passes finished\n", result.passes);
    return fmt::format("stopped  with {} of {} pixels finished\n", result.render.finished_pixels,
                       std::int64_t{1} * job.rendered_window().width() * job.rendered_window().height());
}

int render_command(const RenderRequest& request) {
    parallel::CancelToken& cancel = cli::cancel_by_signals();
    const Job job = prepare(request);
    RenderJournal journal(job);
    PictureOutputs outputs(job);
    outputs.use(journal.still());
    journal.set_hidden_files(outputs.hidden_files());
    cli::PlannedFiles others;
    if (!job.statistics.empty()) others.plan(job.statistics);
    cli::ProgressPrinter progress(job.quiet);
    const strata::render::RenderOptions options{.threads = job.threads,
                                                .tile = job.tile,
                                                .on_progress = progress.callback(),
                                                .cancel = &cancel,
                                                .channels = job.aovs,
                                                .keeper = journal.still(),
                                                .shard = job.shard ? &*job.shard : nullptr};
    const auto tell_end = [&](const strata::render::ProgressiveResult& result) {
        progress.clear();
        job::warn_of_unresolved(result.render.counters.unresolved_rays, job.quiet);
        if (result.render.cancelled && !job.quiet) cli::print_out(stopped_line(job, result));
    };
    Rendered rendered = job.goal.passes > 1 ? render_in_passes(job, outputs, options, journal.passes(), tell_end)
                                            : render_streamed(job, outputs, options, cancel, tell_end);
    journal.end(rendered.all_written && !rendered.result.render.cancelled);
    RunStatistics statistics = collect(rendered.result, job.goal, job.loaded.name);
    statistics.settings_mark = job::settings_mark(job.picture);
    if (!job.statistics.empty()) others.write(job.statistics, statistics_json(statistics));
    if (!job.quiet) cli::print_out(summary(statistics));
    return cli::exit_code_of(rendered.all_written && others.all_written());
}

double parse_target(const std::string& text) {
    constexpr double kLeast = 1e-9, kMost = 1e6;
    const auto value = scene::typed_number(text);
    if (value && *value >= kLeast && *value <= kMost) return *value;
    throw cli::UsageError(
        fmt::format("--target-rmse {}: allowed: a linear radiance, {} to {}", scene::excerpt(text), kLeast, kMost));
}

void add_journal_options(cli::Command& command, job::JournalOptions& options) {
    command.add_flag("--restart", options.restart, "Throw an earlier journal away and begin anew");
    command.add_flag("--no-journal", options.is_unwanted, "Keep no journal of finished work");
    command.add_option(
        "--journal-every",
        [&options](const std::string& text) { options.interval_s = cli::parse_duration("--journal-every", text); },
        "30s|2m", "Write the journal of finished work to the disk after such a time; default 30s");
}

void add_pass_options(cli::Command& command, RenderRequest& request) {
    command.add_option(
        "--target-rmse", [&request](const std::string& text) { request.target_rmse = parse_target(text); }, "E",
        "Add passes, four at least, until the sampling error of linear radiance, told from the passes themselves, is "
        "at most this RMSE with 95 % confidence");
    command.add_option(
        "--time-limit",
        [&request](const std::string& text) { request.time_limit_s = cli::parse_duration("--time-limit", text); },
        "60s|2m|1.5h", "Add passes as long as the next is predicted to end within this time; one at least");
}

}  // namespace

void add_picture_options(cli::Command& command, RenderRequest& request) {
    cli::add_crop(command, request.crop);
    cli::add_tracer(command, request.tracer);
    cli::add_simd(command, &request.is_simd_pinned);
    command.add_option("--format", request.format, "NAME",
                       "EXR channels: half (up to 65504) or float; default half. Or what goes to standard output or a "
                       "pipe: exr (the default), png, tif or jpg");
    command.add_flag("--tiled", request.tiled,
                     "EXR in tiles of 64x64, as from 4096 pixels on either side without being asked");
    command.add_option("--aov", request.aov, "all|NAME,...",
                       "Also keep other channels than colour, each with a filter of its own: those named at the end, "
                       "or all that the estimator has; in EXRs, as 32-bit channels. Of steps and evals false-colour "
                       "pictures NAME.steps.png and NAME.evals.png are drawn as well");
    command.add_option("--layer-prefix", request.layer_prefix, "PREFIX",
                       "In front of their names, as Blender has the view layer's: PREFIX.N.X; default none");
    command.add_option("--passes", request.passes, 1, strata::render::kMostPasses, "K",
                       "Average so many passes of N*N samples, each with its own sample positions; beside "
                       "--target-rmse or --time-limit at most so many; default 1");
}

void add_command(cli::Command& program) {
    cli::Command* command = program.add_subcommand("render", "Render a scene to pictures");
    auto request = std::make_shared<RenderRequest>();
    request->scene.add_to(*command);
    command
        ->add_option("-o,--output", request->outputs, "FILE",
                     "A picture to write, by extension .exr, .png, .tif or .jpg (may be repeated); - for standard "
                     "output; default SCENE.exr and SCENE.png in the current folder")
        ->repeated();
    cli::add_threads(*command, request->threads);
    command->add_option("--tile", request->tile, 1, kLargestTile, "n",
                        "Side of a tile in pixels, 1 to 1024; the picture does not depend on it");
    add_picture_options(*command, *request);
    command->add_option("--layers", request->layers, "one|separate",
                        "Where other channels go: one EXR with the colour, or separate EXRs NAME.LAYER.exr; default "
                        "one");
    command->add_option("--stats", request->statistics, "FILE.json", "Write counts and times as JSON");
    add_pass_options(*command, *request);
    command->add_option("--shard", request->shard, "i/n",
                        "Render part i of n alone, blocks of 64x64 pixels from all over the picture, into an EXR that "
                        "`strata merge` puts together with the others; default SCENE.i-of-n.exr");
    add_journal_options(*command, request->journal);
    cli::add_quiet(*command, request->quiet);
    command->footer(
        "Frame: pixel (0,0) is top left, its centre at (0.5, 0.5); u runs right, v down. World: right-handed, y up.\n"
        "EXR and TIFF keep the crop as data window in the frame; PNG and JPEG hold the crop alone.\n"
        "One pass is written while it is rendered, to a hidden file that gets its name when it is whole: memory does\n"
        "not grow with the height. Several passes, and JPEG, are held whole.\n"
        "Into standard output (-) and named pipes a picture goes when it is whole, and nothing of one that was "
        "interrupted;\nmessages go to standard error then. `-o png:-` is `-o - --format png`. SCENE - is read from "
        "standard input.\n"
        "A picture given as SCENE is rendered again as its metadata say, --crop, --aov, --layers, --format, --tiled, "
        "--tracer, --simd and --passes included; at another --size a crop shows the same part of the frame.\n"
        "The picture of K passes is the same whatever stopped it at K: its metadata hold K, and --passes K makes it "
        "again.\nThe sampling error that is told is that of this picture, before it is rounded for a file, against "
        "infinitely many passes of the same N and tolerance; the bias of jittered and shared, which falls with the "
        "number of passes, is in it. Hits off the surface by up to the tolerance are not.\n"
        "What is finished is also kept in a journal, NAME.EXT.journal beside the first output, from a sixth of\n"
        "--journal-every on and until the picture is whole. After a crash or a signal the same command goes on from\n"
        "it, to the same bits; with other settings it stops and lists what differs.\n"
        "On SIGINT, SIGTERM or SIGHUP what is finished is written as NAME.partial.EXT, of several passes the mean of "
        "the whole ones; an earlier NAME.EXT stays.\n"
        "A file that cannot be put in place is kept whole as NAME.kept.EXT, beside it or in TMPDIR, and told; the "
        "others are written.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.\n"
        "Channels of --aov, with their filters. picture: weighted as colour is; the others are of the samples that are "
        "placed for a pixel, of shared ones those in its square: mean: each counts alike; nearest: that nearest to the "
        "pixel's centre; min: the least; sum; variance: that of their mean.\n" +
        job::aov_table());
    command->action([request] { return render_command(*request); });
}

}  // namespace strata::tools::render
