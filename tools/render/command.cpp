#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <memory>

#include "src/integrate/make_image.h"
#include "src/parallel/cancel.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/standard_output.h"
#include "tools/job/picture_outputs.h"
#include "tools/job/render_job.h"
#include "tools/job/run_statistics.h"
#include "tools/job/settings_mark.h"

namespace strata::tools::render {

namespace {

// Of one pass the metadata tell no number.
image::Metadata metadata_of(const job::Job& job, const strata::render::ProgressiveResult& result) {
    return job::final_metadata(job, result.passes, result.render.cancelled);
}

bool finish(job::PictureOutputs& outputs, const job::Job& job, const strata::render::ProgressiveResult& result) {
    return result.render.cancelled ? outputs.finish_partial(metadata_of(job, result)) : outputs.finish();
}

struct Rendered {
    strata::render::ProgressiveResult result;
    bool all_written = true;
};

// Called between the last ray and the end of the files.
using TellEnd = std::function<void(const strata::render::ProgressiveResult&)>;

// One pass goes into its files while it is rendered.
Rendered render_streamed(const job::Job& job, job::PictureOutputs& outputs,
                         const strata::render::RenderOptions& options, parallel::CancelToken& cancel,
                         const TellEnd& tell_end) {
    const auto image = integrate::make_image(job.loaded.scene, cli::parse_tracer(job.tracer));
    const estimate::Estimator estimator(estimate::estimator_settings(job.loaded.scene));
    outputs.begin(job.metadata);
    Rendered rendered;
    strata::render::ProgressiveResult& result = rendered.result;
    result.render = strata::render::render_strips(*image, estimator, job.window, options, image::kStripRows,
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
Rendered render_in_passes(const job::Job& job, job::PictureOutputs& outputs,
                          const strata::render::RenderOptions& options, const TellEnd& tell_end) {
    const auto image = integrate::make_image(job.loaded.scene, cli::parse_tracer(job.tracer));
    Rendered rendered;
    strata::render::ProgressiveResult& result = rendered.result;
    result = strata::render::render_progressively(*image, estimate::estimator_settings(job.loaded.scene), job.window,
                                                  job.goal, options);
    tell_end(result);
    outputs.begin_late(metadata_of(job, result));
    outputs.write_whole(result.render.film);
    rendered.all_written = finish(outputs, job, result);
    return rendered;
}

void warn_of_unresolved(const job::Job& job, std::uint64_t rays) {
    if (rays == 0 || job.quiet) return;
    cli::print_error(fmt::format("warning: {} {} not settled within {} steps; drawn in magenta, or as shadow", rays,
                                 rays == 1 ? "ray was" : "rays were", trace::kStepLimit));
}

std::string stopped_line(const job::Job& job, const strata::render::ProgressiveResult& result) {
    if (result.passes > 0) return fmt::format("stopped  with {} passes finished\n", result.passes);
    return fmt::format("stopped  with {} of {} pixels finished\n", result.render.finished_pixels,
                       std::int64_t{1} * job.window.width() * job.window.height());
}

int render_command(const job::RenderRequest& request) {
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    const job::Job job = job::prepare(request);
    job::PictureOutputs outputs(job);
    cli::PlannedFiles others;
    if (!job.statistics.empty()) others.plan(job.statistics);
    cli::ProgressPrinter progress(job.quiet);
    const strata::render::RenderOptions options{.threads = job.threads,
                                                .tile = job.tile,
                                                .on_progress = progress.callback(),
                                                .cancel = &cancel,
                                                .with_costs = !job.aovs.empty()};
    const auto tell_end = [&](const strata::render::ProgressiveResult& result) {
        progress.clear();
        warn_of_unresolved(job, result.render.counters.unresolved_rays);
        if (result.render.cancelled && !job.quiet) cli::print_out(stopped_line(job, result));
    };
    Rendered rendered = job.goal.passes > 1 ? render_in_passes(job, outputs, options, tell_end)
                                            : render_streamed(job, outputs, options, cancel, tell_end);
    job::RunStatistics statistics = job::collect(rendered.result, job.goal, job.loaded.name);
    statistics.settings_mark = job::settings_mark(job.loaded.scene, job.window, job.tracer);
    if (!job.statistics.empty()) others.write(job.statistics, job::statistics_json(statistics));
    if (!job.quiet) cli::print_out(job::summary(statistics));
    if (!rendered.all_written || !others.all_written()) return cli::kExitRuntime;
    // A signal that came too late to stop the render is still why the user expects an end.
    return parallel::cancelling_signal() != 0 ? cli::kExitSignal + parallel::cancelling_signal() : 0;
}

}  // namespace

void add_command(cli::Command& program, int& exit_code) {
    cli::Command* command = program.add_subcommand("render", "Render a scene to pictures");
    auto request = std::make_shared<job::RenderRequest>();
    request->scene.add_to(*command);
    command
        ->add_option("-o,--output", request->outputs,
                     "A picture to write, by extension .exr, .png, .tif or .jpg (may be repeated); - for standard "
                     "output; default SCENE.exr and SCENE.png in the current folder")
        ->type_name("FILE")
        ->repeated();
    command
        ->add_option("--crop", request->crop,
                     "Render pixels [x0,x1) x [y0,y1) of the frame alone, y down; default the whole frame")
        ->type_name("x0,y0,x1,y1");
    command->add_option("--threads", request->threads, "Threads, up to 1024; 0: as many as machine and container give")
        ->type_name("n")
        ->capture_default_str();
    command
        ->add_option("--tile", request->tile, "Side of a tile in pixels, 1 to 1024; the picture does not depend on it")
        ->type_name("n")
        ->capture_default_str();
    command
        ->add_option("--tracer", request->tracer, "fast, or reference (plain sphere tracing in double); default fast")
        ->type_name("NAME");
    command->add_option("--simd", request->simd, "avx512, avx2, sse4 or scalar; default the best that is here")
        ->type_name("TARGET");
    command
        ->add_option("--format", request->format,
                     "EXR channels: half (up to 65504) or float; default half. Or what goes to standard output or a "
                     "pipe: exr (the "
                     "default), png, tif or jpg")
        ->type_name("NAME");
    command->add_flag("--tiled", request->tiled,
                      "EXR in tiles of 64x64, as from 4096 pixels on either side without being asked");
    command
        ->add_option("--aov", request->aov,
                     "Also keep what pixels cost, as means over their own samples: tracer steps, noise evaluations; in "
                     "EXR as 32-bit channels steps.Y and evals.Y, and as false-colour pictures NAME.steps.png and "
                     "NAME.evals.png beside the first output")
        ->type_name("steps,evals");
    command->add_option("--stats", request->statistics, "Write counts and times as JSON")->type_name("FILE.json");
    command
        ->add_option("--passes", request->passes,
                     "Average so many passes of N*N samples, each with its own sample positions; beside --target-rmse "
                     "or --time-limit at most so many; default 1")
        ->type_name("K");
    command
        ->add_option("--target-rmse", request->target_rmse,
                     "Add passes, four at least, until the sampling error of linear radiance, told from the passes "
                     "themselves, is at most "
                     "this RMSE with 95 % confidence")
        ->type_name("E");
    command
        ->add_option("--time-limit", request->time_limit,
                     "Add passes as long as the next is predicted to end within this time; one at least")
        ->type_name("60s|2m|1.5h");
    command->add_flag("--quiet", request->quiet, "No progress, summary or warnings");
    command->footer(
        "Frame: pixel (0,0) is top left, its centre at (0.5, 0.5); u runs right, v down. World: right-handed, y up.\n"
        "EXR and TIFF keep the crop as data window in the frame; PNG and JPEG hold the crop alone.\n"
        "One pass is written while it is rendered, to a hidden file that gets its name when it is whole: memory does\n"
        "not grow with the height. Several passes, and JPEG, are held whole.\n"
        "Into standard output (-) and named pipes a picture goes when it is whole, and nothing of one that was "
        "interrupted;\nmessages go to standard error then. `-o png:-` is `-o - --format png`. SCENE - is read from "
        "standard input.\n"
        "A picture given as SCENE is rendered again as its metadata say, --crop, --aov, --format, --tiled, "
        "--tracer, --simd and --passes included; at another --size a crop shows the same part of the frame.\n"
        "The picture of K passes is the same whatever stopped it at K: its metadata hold K, and --passes K makes it "
        "again."
        "\nThe sampling error that is told is that of this picture, before it is rounded for a file, against "
        "infinitely "
        "many passes of the same N and tolerance; the bias of jittered and shared, which falls with the number of "
        "passes, is in it. Hits off the surface by up to the tolerance are not.\n"
        "On SIGINT, SIGTERM or SIGHUP what is finished is written as NAME.partial.EXT, of several passes the mean of "
        "the whole ones; an earlier NAME.EXT stays.\n"
        "A file that cannot be put in place is kept whole as NAME.kept.EXT, beside it or in TMPDIR, and told; the "
        "others are written.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->callback([request, &exit_code] { exit_code = render_command(*request); });
}

}  // namespace strata::tools::render
