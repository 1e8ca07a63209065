#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "src/image/compare.h"
#include "src/image/encode.h"
#include "src/image/image_error.h"
#include "src/image/picture_metadata.h"
#include "src/parallel/cancel.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/progress_printer.h"
#include "tools/cli/standard_output.h"
#include "tools/job/batch_progress.h"
#include "tools/job/render_picture.h"
#include "tools/strip/job.h"
#include "tools/strip/sheet.h"

namespace strata::tools::strip {

namespace {

constexpr const char* kTracer = "fast";

void write_part(cli::PlannedFiles& files, const StripJob& job, const StripSource& source,
                const std::filesystem::path& path) {
    image::WriteOptions options{.exr_format = image::ExrFormat::floating};
    image::Metadata metadata;
    if (source.scene && source.file.empty()) {
        metadata = image::picture_metadata(*source.scene, job.window, kTracer, "float");
        options.frames_per_second = image::frame_rate(*source.scene);
    } else {
        metadata.set("strata:part_of", source.name);
        options.keeps_not_finite = true;
    }
    files.write_made(path, [&] { return image::encode(path, source.picture, metadata, options); });
}

class StripRenderer {
  public:
    StripRenderer(StripJob& job, cli::PlannedFiles& files, const parallel::CancelToken& cancel)
        : job_(job),
          files_(files),
          cancel_(cancel),
          printer_(job.quiet),
          progress_(total_rays(job), printer_.callback()) {}

    // False when it was stopped.
    bool run() {
        for (std::size_t i = 0; i < job_.columns.size(); ++i) {
            if (!complete(job_.columns[i], part_path(job_, i))) return false;
        }
        return !job_.reference || complete(*job_.reference, part_path(job_, std::nullopt));
    }

  private:
    static double total_rays(const StripJob& job) {
        double total = 0;
        for (const StripSource& column : job.columns)
            if (column.file.empty()) total += job::expected_rays(*column.scene, job.window);
        if (job.reference && job.reference->file.empty())
            total += job::expected_rays(*job.reference->scene, job.window);
        return total;
    }

    bool complete(StripSource& source, const std::filesystem::path& part) {
        if (source.file.empty()) {
            const double weight = job::expected_rays(*source.scene, job_.window);
            job::RenderedPicture rendered = job::render_picture(
                *source.scene, job_.window, cli::parse_tracer(kTracer),
                {.threads = job_.threads, .on_progress = progress_.next(weight), .cancel = &cancel_});
            printer_.clear();
            if (rendered.result.cancelled) return false;
            source.picture = std::move(rendered.picture);
        }
        if (job_.parts) write_part(files_, job_, source, part);
        return true;
    }

    StripJob& job_;
    cli::PlannedFiles& files_;
    const parallel::CancelToken& cancel_;
    cli::ProgressPrinter printer_;
    job::BatchProgress progress_;
};

// What the sheet's format does not hold, found on a sheet of black pictures before the first ray.
void check_sheet(const StripJob& job) {
    const auto is_rendered = [](const StripSource& source) { return source.file.empty(); };
    if (std::ranges::none_of(job.columns, is_rendered) && !(job.reference && is_rendered(*job.reference))) return;
    StripJob black = job;
    const film::Rect& w = job.window;
    for (StripSource& column : black.columns) {
        if (column.file.empty()) column.picture = image::make_picture(w.width(), w.height());
    }
    if (black.reference && black.reference->file.empty())
        black.reference->picture = image::make_picture(w.width(), w.height());
    try {
        const image::Canvas sheet = draw_strip(black);
        image::check_encodable(job.output, {sheet.width, sheet.height, 0, 0, sheet.width, sheet.height},
                               strip_metadata(job), {});
    } catch (const image::ImageError& error) {
        throw cli::UsageError(error.what());
    }
}

int strip_command(const StripRequest& request) {
    static parallel::CancelToken cancel;
    parallel::cancel_on_signals(cancel);
    StripJob job = prepare_strip(request);
    check_sheet(job);
    cli::PlannedFiles files;
    for (const std::filesystem::path& path : strip_files(job)) files.plan(path);
    if (!StripRenderer(job, files, cancel).run()) {
        if (!job.quiet) cli::print_out("stopped  before the strip was complete; parts that were finished are kept\n");
        return cli::kExitSignal + parallel::cancelling_signal();
    }
    const bool is_drawn = files.write_made(
        job.output, [&] { return image::encode_canvas(job.output, draw_strip(job), strip_metadata(job)); });
    if (is_drawn && !job.quiet) cli::print_out(fmt::format("wrote    {}\n", job.output.string()));
    if (!files.all_written()) return cli::kExitRuntime;
    return parallel::cancelling_signal() != 0 ? cli::kExitSignal + parallel::cancelling_signal() : 0;
}

void add_look_options(cli::Command& command, StripRequest& request) {
    command.add_option("--crop", request.crop, "Show pixels [x0,x1) x [y0,y1) of the frame alone, y down")
        ->type_name("x0,y0,x1,y1");
    command.add_option("--zoom", request.zoom, "Show each pixel as n x n, 1 to 64; default: panels near 256 px wide")
        ->type_name("n");
    command.add_option("--labels", request.labels, "A label for each picture instead of the automatic ones")
        ->type_name("\"A; B; ...\"");
    command.add_option("--title", request.title, "Over the strip; default the scene's title")->type_name("TEXT");
    command.add_option("--caption", request.caption, "Under the strip; default what part of the frame it is")
        ->type_name("TEXT");
}

}  // namespace

void add_command(cli::Command& program, int& exit_code) {
    cli::Command* command = program.add_subcommand("strip", "Show pictures side by side, magnified and compared");
    auto request = std::make_shared<StripRequest>();
    command->add_option("PICTURE", request->pictures, "Pictures to show: EXR, PNG, TIFF or JPEG");
    request->scene.add_to(*command, "--scene");
    command
        ->add_option("--columns", request->columns,
                     "With --scene: the pictures to render, their settings between ';', as \"none; N=2; N=10 m=4 "
                     "estimator=sobol; surface.octaves=4\"")
        ->type_name("SETTINGS");
    add_look_options(*command, *request);
    command
        ->add_option("--reference", request->reference,
                     "What to compare with: the number or text of a column, a picture, or, with --scene, settings")
        ->type_name("WHICH");
    command->add_flag("--difference", request->difference, "A row of differences from --reference, with a scale");
    command
        ->add_option("--difference-top", request->top,
                     "Radiance at the scale's top; default from the 99th percentile of the differences")
        ->type_name("VALUE");
    command->add_flag("--rmse", request->rmse, "The root mean square error against --reference under each picture");
    command->add_flag("--parts", request->parts, "Also write what is shown as float EXR: NAME-1.exr, NAME-2.exr, ...");
    command
        ->add_option("-o,--output", request->output,
                     "The strip: .png, .jpg or .tif, or - for standard output; default strip.png")
        ->type_name("FILE");
    command->add_option("--threads", request->threads, "Threads, up to 1024; 0: as many as machine and container give")
        ->type_name("n")
        ->capture_default_str();
    command->add_option("--simd", request->simd, "avx512, avx2, sse4 or scalar; default the best that is here")
        ->type_name("TARGET");
    command->add_flag("--quiet", request->quiet, "No progress or summary");
    command->footer(
        "With --scene only the crop is rendered. Columns are shown with their own exposure and tone, pictures with\n"
        "the scene's, or those of the first picture. Errors are of linear radiance, over all channels. EXR, and TIFF\n"
        "in floating point, are linear. Whole numbers are sRGB codes unless the file says otherwise (gAMA, cICP, an\n"
        "ICC profile): they are decoded and their exposure undone; what they clipped stays clipped, and codes behind\n"
        "a tone curve are refused. Grey is shown as grey, alpha over black, and pixels that are not finite in cyan,\n"
        "with a warning.\n"
        "  strata strip a.exr b.exr --crop 100,60,140,90 --zoom 8 -o strip.png\n"
        "  strata strip --scene terrain --columns \"none; N=2; N=10\" --crop 600,330,640,360 --reference N=10 --rmse\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line, scene or picture, 129, 130 or 143 "
        "interrupted.");
    command->callback([request, command, &exit_code] {
        request->has_scene = command->count("--scene") > 0;
        exit_code = strip_command(*request);
    });
}

}  // namespace strata::tools::strip
