#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "noise/simd_target.h"
#include "src/image/output_file.h"
#include "src/image/write.h"
#include "src/render/cancel.h"
#include "src/render/make_image.h"
#include "src/render/progress_printer.h"
#include "src/render/render.h"
#include "src/scene/enum_names.h"
#include "src/scene/printer.h"
#include "tools/commands.h"
#include "tools/errors.h"
#include "tools/run_statistics.h"
#include "tools/scene_argument.h"

namespace strata::tools {

namespace {

namespace fs = std::filesystem;

struct RenderRequest {
    SceneArgument scene;
    std::vector<std::string> outputs;
    std::string crop, tracer, simd, format, statistics;
    int threads = 0, tile = 32;
    bool quiet = false;
};

// All that is known before the first ray.
struct Job {
    LoadedScene loaded;
    render::Window window;
    std::vector<fs::path> outputs;
    image::WriteOptions write;
    image::Metadata metadata;
    std::string tracer;
};

// An option given here, else what the picture that is rendered again recorded, else the default.
std::string choose(const std::string& given, const std::optional<std::string>& recorded, const char* otherwise) {
    return !given.empty() ? given : recorded.value_or(otherwise);
}

image::ExrFormat parse_format(const std::string& name) {
    if (name == "half") return image::ExrFormat::half;
    if (name == "float") return image::ExrFormat::floating;
    throw UsageError(fmt::format("--format {}: allowed: half, float", name));
}

std::vector<fs::path> output_paths(const RenderRequest& request, const std::string& name) {
    if (request.outputs.empty()) return {name + ".exr", name + ".png"};
    return {request.outputs.begin(), request.outputs.end()};
}

// How the picture is made: nothing here differs between equal renders.
image::Metadata describe(const Job& job, const std::string& crop, const std::string& format) {
    const scene::Sampling& sampling = job.loaded.scene.sampling;
    image::Metadata metadata;
    metadata.set("strata:version", STRATA_VERSION);
    metadata.set(image::kSceneKey, scene::print_scene(job.loaded.scene));
    if (!crop.empty()) metadata.set("strata:crop", crop);
    metadata.set("strata:tracer", job.tracer);
    metadata.set("strata:format", format);
    metadata.set("strata:simd_target", noise::simd_target());
    metadata.set("strata:estimator", scene::name_of(sampling.estimator));
    metadata.set("strata:samples", sampling.estimator == scene::EstimatorKind::none ? 1 : sampling.N * sampling.N);
    metadata.set("strata:filter", fmt::format("B-spline of order {}", sampling.m));
    metadata.set("strata:seed", sampling.seed);
    return metadata;
}

Job prepare(const RenderRequest& request) {
    Job job;
    if (request.threads < 0) throw UsageError(fmt::format("--threads {}: allowed: 0 (all) or more", request.threads));
    if (request.tile < 1) throw UsageError(fmt::format("--tile {}: allowed: 1 or more", request.tile));
    if (!request.simd.empty()) use_simd_target(request.simd);
    job.loaded = request.scene.load();
    const scene::Film& film = job.loaded.scene.film;
    const std::string crop = choose(request.crop, job.loaded.crop, "");
    job.window = crop.empty() ? render::Window{0, 0, film.width, film.height} : parse_crop(crop, film);
    job.tracer = choose(request.tracer, job.loaded.tracer, "fast");
    parse_tracer(job.tracer);
    const std::string format = choose(request.format, job.loaded.exr_format, "half");
    job.write = {.exposure = film.exposure, .exr_format = parse_format(format)};
    job.outputs = output_paths(request, job.loaded.name);
    for (const fs::path& path : job.outputs) {
        image::check_writable(path);
        image::check_size(path, job.window.width(), job.window.height());
    }
    job.metadata = describe(job, crop, format);
    return job;
}

image::Picture to_picture(const render::Film& film, const scene::Film& frame) {
    const render::Window& w = film.window();
    image::Picture picture{frame.width, frame.height, w.x0, w.y0, w.x1, w.y1, {}};
    picture.rgb.reserve(3 * film.pixels().size());
    for (const glm::vec3& pixel : film.pixels()) picture.rgb.insert(picture.rgb.end(), {pixel.r, pixel.g, pixel.b});
    return picture;
}

// NAME.partial.EXT beside NAME.EXT.
fs::path partial_path(fs::path path) {
    const std::string extension = path.extension().string();
    return path.replace_extension(".partial" + extension);
}

void write_outputs(const Job& job, const render::RenderResult& result, bool quiet) {
    const image::Picture picture = to_picture(result.film, job.loaded.scene.film);
    image::Metadata metadata = job.metadata;
    if (result.cancelled) metadata.set("strata:partial", "unfinished pixels are black");
    for (const fs::path& path : job.outputs) {
        const fs::path target = result.cancelled ? partial_path(path) : path;
        image::write_picture(target, picture, metadata, job.write);
        if (!quiet) fmt::print("wrote    {}\n", target.string());
    }
}

int render_command(const RenderRequest& request) {
    const Job job = prepare(request);
    const scene::Scene& scene = job.loaded.scene;
    static render::CancelToken cancel;
    render::cancel_on_signals(cancel);
    const auto image_function = render::make_image(scene, parse_tracer(job.tracer));
    const render::Estimator estimator(render::estimator_settings(scene));
    render::ProgressPrinter progress(request.quiet);
    const render::RenderResult result = render::render(
        *image_function, estimator, job.window,
        {.threads = request.threads, .tile = request.tile, .on_progress = progress.callback(), .cancel = &cancel});
    progress.clear();
    const RunStatistics statistics = collect(result, request.threads, job.loaded.name);
    if (!request.quiet) fmt::print("{}", summary(statistics));
    if (!request.statistics.empty()) write_statistics(request.statistics, statistics);
    write_outputs(job, result, request.quiet);
    if (result.counters.unresolved_rays > 0) {
        fmt::print(stderr, "strata: warning: {} rays were not settled within {} steps; they are drawn in magenta\n",
                   result.counters.unresolved_rays, trace::kStepLimit);
    }
    return result.cancelled ? kExitSignal + render::cancelling_signal() : 0;
}

}  // namespace

void add_render_command(CLI::App& program, int& exit_code) {
    CLI::App* command = program.add_subcommand("render", "Render a scene to pictures");
    auto request = std::make_shared<RenderRequest>();
    request->scene.add_to(*command);
    command
        ->add_option("-o,--output", request->outputs,
                     "A picture to write, by extension .exr, .png, .tif or .jpg (may be repeated); default SCENE.exr "
                     "and SCENE.png in the current folder")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--crop", request->crop, "Render pixels [x0,x1) x [y0,y1) of the frame alone, y down")
        ->type_name("x0,y0,x1,y1");
    command->add_option("--threads", request->threads, "Threads; 0: as many as the machine has")->capture_default_str();
    command->add_option("--tile", request->tile, "Side of a tile in pixels; the picture does not depend on it")
        ->capture_default_str();
    command
        ->add_option("--tracer", request->tracer, "fast, or reference (plain sphere tracing in double); default fast")
        ->type_name("NAME");
    command->add_option("--simd", request->simd, "avx512, avx2, sse4 or scalar; default the best that is here")
        ->type_name("TARGET");
    command->add_option("--format", request->format, "EXR channels: half or float; default half")->type_name("NAME");
    command->add_option("--stats", request->statistics, "Write counts and times as JSON")->type_name("FILE.json");
    command->add_flag("--quiet", request->quiet, "No progress, no summary");
    command->footer(
        "Frame: pixel (0,0) is top left, its centre at (0.5, 0.5); u runs right, v down. World: right-handed, y up.\n"
        "EXR and TIFF keep the crop as data window in the frame; PNG and JPEG hold the crop alone.\n"
        "On SIGINT or SIGTERM what is finished is written as NAME.partial.EXT.\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 130 or 143 interrupted.");
    command->callback([request, &exit_code] { exit_code = render_command(*request); });
}

}  // namespace strata::tools
