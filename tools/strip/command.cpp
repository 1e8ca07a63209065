#include <fmt/format.h>

#include <memory>
#include <utility>
#include <vector>

#include "src/image/compare.h"
#include "src/image/encode.h"
#include "src/image/image_error.h"
#include "src/parallel/cancel.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/job/batch.h"
#include "tools/strip/job.h"
#include "tools/strip/sheet.h"

namespace strata::tools::strip {

namespace {

namespace fs = std::filesystem;

void write_part(cli::PlannedFiles& files, const Job& job, const Source& source, const fs::path& path) {
    image::WriteOptions options{.exr_format = image::ExrFormat::floating};
    image::Metadata metadata;
    if (source.scene && source.file.empty()) {
        const job::PictureJob picture{*source.scene, job.window};
        metadata = picture.metadata("float");
        options = picture.float_exr();
    } else {
        metadata.set("strata:part_of", source.name);
        options.keeps_not_finite = true;
    }
    files.write_made(path, [&] { return image::encode(path, source.picture, metadata, options); });
}

// The pictures and where their parts go.
std::vector<std::pair<Source*, fs::path>> sources_of(Job& job) {
    std::vector<std::pair<Source*, fs::path>> sources;
    for (std::size_t i = 0; i < job.columns.size(); ++i) sources.emplace_back(&job.columns[i], part_path(job, i));
    if (job.reference) sources.emplace_back(&*job.reference, part_path(job, std::nullopt));
    return sources;
}

// Renders what is no file. False when it was stopped.
bool complete(Job& job, cli::PlannedFiles& files, const parallel::CancelToken& cancel) {
    job::Batch batch(job.threads, job.quiet, cancel);
    const auto sources = sources_of(job);
    for (const auto& [source, part] : sources) {
        if (source->file.empty()) batch.expect({*source->scene, job.window});
    }
    for (const auto& [source, part] : sources) {
        if (source->file.empty()) {
            auto rendered = batch.render({*source->scene, job.window});
            if (!rendered) return false;
            batch.clear_progress();
            source->picture = std::move(rendered->picture);
        }
        if (job.parts) write_part(files, job, *source, part);
    }
    return true;
}

// What the sheet's format does not hold, found on a sheet of black pictures before the first ray.
void check_sheet(const Job& job) {
    Job black = job;
    bool is_rendered = false;
    for (const auto& [source, part] : sources_of(black)) {
        if (!source->file.empty()) continue;
        source->picture = image::make_picture(job.window.width(), job.window.height());
        is_rendered = true;
    }
    if (!is_rendered) return;
    try {
        const image::Canvas sheet = draw_strip(black);
        image::check_encodable(job.output, {sheet.width, sheet.height, 0, 0, sheet.width, sheet.height},
                               strip_metadata(job), {});
    } catch (const image::ImageError& error) {
        throw cli::UsageError(error.what());
    }
}

int strip_command(const Request& request) {
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    Job job = prepare_strip(request);
    check_sheet(job);
    cli::PlannedFiles files;
    for (const fs::path& path : strip_files(job)) files.plan(path);
    if (!complete(job, files, cancel)) {
        if (!job.quiet) cli::print_out("stopped  before the strip was complete; parts that were finished are kept\n");
        return cli::exit_code_of(true);
    }
    const bool is_drawn = files.write_made(
        job.output, [&] { return image::encode_canvas(job.output, draw_strip(job), strip_metadata(job)); });
    if (is_drawn && !job.quiet) cli::print_out(fmt::format("wrote    {}\n", job.output.string()));
    return cli::exit_code_of(files.all_written());
}

void add_look_options(cli::Command& command, Request& request) {
    cli::add_crop(command, request.crop, "Show");
    command.add_option("--zoom", request.zoom, 1, kMostZoom, "n",
                       "Show each pixel as n x n, 1 to 64; default: panels near 256 px wide");
    command.add_option("--labels", request.labels, "\"A; B; ...\"",
                       "A label for each picture instead of the automatic ones");
    command.add_option("--title", request.title, "TEXT", "Over the strip; default the scene's title");
    command.add_option("--caption", request.caption, "TEXT", "Under the strip; default what part of the frame it is");
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command = program.add_subcommand("strip", "Show pictures side by side, magnified and compared");
    auto request = std::make_shared<Request>();
    command->add_option("PICTURE", request->pictures, "", "Pictures to show: EXR, PNG, TIFF or JPEG");
    request->scene.add_to(*command, "--scene");
    command->add_option("--columns", request->columns, "SETTINGS",
                        "With --scene: the pictures to render, their settings between ';', as \"none; N=2; N=10 m=4 "
                        "estimator=sobol; surface.octaves=4\"");
    add_look_options(*command, *request);
    command->add_option("--reference", request->reference, "WHICH",
                        "What to compare with: the number or text of a column, a picture, or, with --scene, settings");
    command->add_flag("--difference", request->difference, "A row of differences from --reference, with a scale");
    command->add_option("--difference-top", request->top, "VALUE",
                        "Radiance at the scale's top; default from the 99th percentile of the differences");
    command->add_flag("--rmse", request->rmse, "The root mean square error against --reference under each picture");
    command->add_flag("--parts", request->parts, "Also write what is shown as float EXR: NAME-1.exr, NAME-2.exr, ...");
    command->add_option("-o,--output", request->output, "FILE",
                        "The strip: .png, .jpg or .tif, or - for standard output; default strip.png");
    cli::add_threads(*command, request->threads);
    cli::add_simd(*command);
    cli::add_quiet(*command, request->quiet, "No progress or summary");
    command->footer(
        "With --scene only the crop is rendered. Columns are shown with their own exposure and tone, pictures with\n"
        "the scene's, or those of the first picture. Errors are of linear radiance, over all channels. EXR, and TIFF\n"
        "in floating point, are linear. Whole numbers are sRGB codes unless the file says otherwise (gAMA, cICP, an\n"
        "ICC profile): they are decoded and their exposure undone; what they clipped stays clipped, and codes behind\n"
        "a tone curve are refused. Grey is shown as grey, alpha over black, and pixels that are not finite in cyan,\n"
        "with a warning.\n"
        "  strata strip a.exr b.exr --crop 100,60,140,90 --zoom 8 -o strip.png\n"
        "  strata strip --scene hills --columns \"none; N=2; N=10\" --crop 600,330,640,360 --reference N=10 --rmse\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line, scene or picture, 129, 130 or 143 "
        "interrupted.");
    command->action([request, command] {
        request->has_scene = command->count("--scene") > 0;
        return strip_command(*request);
    });
}

}  // namespace strata::tools::strip
