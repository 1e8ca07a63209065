#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>

#include "src/image/write.h"
#include "src/render/cancel.h"
#include "src/render/progress_printer.h"
#include "tools/commands.h"
#include "tools/errors.h"
#include "tools/picture_metadata.h"
#include "tools/render_job.h"
#include "tools/render_picture.h"
#include "tools/run_statistics.h"
#include "tools/settings_mark.h"
#include "tools/standard_output.h"

namespace strata::tools {

namespace {

namespace fs = std::filesystem;

// Runs write(); a failure is told and does not keep other files from being written.
template <class Write>
bool succeeds(const Write& write) {
    try {
        write();
        return true;
    } catch (const std::bad_alloc&) {
        print_error("out of memory while writing");
    } catch (const std::exception& error) {
        print_error(error.what());
    }
    return false;
}

// False if a file could not be written.
bool write_outputs(const Job& job, const image::Picture& picture, const render::ProgressiveResult& result) {
    const bool is_partial = result.render.cancelled;
    image::Metadata metadata = job.metadata;
    set_passes(metadata, job.loaded.scene.sampling, result.passes);
    if (is_partial) {
        metadata.set("strata:partial",
                     result.passes == 0 ? "unfinished pixels are black"
                                        : fmt::format("the mean of {} whole passes; more were wanted", result.passes));
    }
    bool all = true;
    for (const fs::path& path : job.outputs) {
        const fs::path target = is_partial ? partial_path(path) : path;
        const bool written = succeeds([&] { image::write_picture(target, picture, metadata, job.write); });
        if (written && !job.quiet) print_out(fmt::format("wrote    {}\n", target.string()));
        all = all && written;
    }
    return all;
}

void warn_of_unresolved(const Job& job, std::uint64_t rays) {
    if (rays == 0 || job.quiet) return;
    print_error(fmt::format("warning: {} {} not settled within {} steps; drawn in magenta, or as shadow", rays,
                            rays == 1 ? "ray was" : "rays were", trace::kStepLimit));
}

std::string stopped_line(const ProgressivePicture& rendered) {
    if (rendered.result.passes > 0) return fmt::format("stopped  with {} passes finished\n", rendered.result.passes);
    return fmt::format("stopped  with {} of {} pixels finished\n", rendered.finished_pixels, rendered.picture.pixels());
}

int render_command(const RenderRequest& request) {
    static render::CancelToken cancel;
    render::cancel_on_signals(cancel);
    const Job job = prepare(request);
    render::ProgressPrinter progress(job.quiet);
    const ProgressivePicture rendered = render_picture(
        job.loaded.scene, job.window, parse_tracer(job.tracer), job.goal,
        {.threads = job.threads, .tile = job.tile, .on_progress = progress.callback(), .cancel = &cancel});
    progress.clear();
    const render::ProgressiveResult& result = rendered.result;
    warn_of_unresolved(job, result.render.counters.unresolved_rays);
    if (result.render.cancelled && !job.quiet) print_out(stopped_line(rendered));
    bool all_written = write_outputs(job, rendered.picture, result);
    RunStatistics statistics = collect(result, job.goal, job.loaded.name);
    statistics.settings_mark = settings_mark(job.loaded.scene, job.window, job.tracer);
    if (!job.statistics.empty()) all_written &= succeeds([&] { write_statistics(job.statistics, statistics); });
    if (!job.quiet) print_out(summary(statistics));
    if (!all_written) return kExitRuntime;
    // A signal that came too late to stop the render is still why the user expects an end.
    return render::cancelling_signal() != 0 ? kExitSignal + render::cancelling_signal() : 0;
}

}  // namespace

void add_render_command(Command& program, int& exit_code) {
    Command* command = program.add_subcommand("render", "Render a scene to pictures");
    auto request = std::make_shared<RenderRequest>();
    request->scene.add_to(*command);
    command
        ->add_option("-o,--output", request->outputs,
                     "A picture to write, by extension .exr, .png, .tif or .jpg (may be repeated); default SCENE.exr "
                     "and SCENE.png in the current folder")
        ->type_name("FILE")
        ->repeated();
    command
        ->add_option("--crop", request->crop,
                     "Render pixels [x0,x1) x [y0,y1) of the frame alone, y down; default the whole frame")
        ->type_name("x0,y0,x1,y1");
    command->add_option("--threads", request->threads, "Threads, up to 1024; 0: as many as the machine has")
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
    command->add_option("--format", request->format, "EXR channels: half or float; default half")->type_name("NAME");
    command->add_option("--stats", request->statistics, "Write counts and times as JSON")->type_name("FILE.json");
    command
        ->add_option("--passes", request->passes,
                     "Average so many passes of N*N samples, each with its own sample positions; beside --target-rmse "
                     "or --time-limit at most so many; default 1")
        ->type_name("K");
    command
        ->add_option(
            "--target-rmse", request->target_rmse,
            "Add passes, four at least, until the noise of linear radiance, told from the passes' differences, "
            "is at most this RMSE with 95 % confidence")
        ->type_name("E");
    command
        ->add_option("--time-limit", request->time_limit,
                     "Add passes as long as the next is predicted to end within this time; one at least")
        ->type_name("60s|2m|1.5h");
    command->add_flag("--quiet", request->quiet, "No progress, summary or warnings");
    command->footer(
        "Frame: pixel (0,0) is top left, its centre at (0.5, 0.5); u runs right, v down. World: right-handed, y up.\n"
        "EXR and TIFF keep the crop as data window in the frame; PNG and JPEG hold the crop alone.\n"
        "A picture given as SCENE is rendered again as its metadata say, --crop, --format, --tracer, --simd and "
        "--passes included.\n"
        "The picture of K passes is the same whatever stopped it at K: its metadata hold K, and --passes K makes it "
        "again."
        "\nThe noise told from differences leaves out what all passes share: the bias, of order 1/N^2, of jittered and "
        "shared.\n"
        "On SIGINT or SIGTERM what is finished is written as NAME.partial.EXT, of several passes the mean of "
        "the whole ones; an earlier NAME.EXT stays.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 130 or 143 interrupted.");
    command->callback([request, &exit_code] { exit_code = render_command(*request); });
}

}  // namespace strata::tools
