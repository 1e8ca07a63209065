#include "tools/animate/job.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/image/file_paths.h"
#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/output_file.h"
#include "src/image/stream_target.h"
#include "src/image/text.h"
#include "src/scene/key_text.h"
#include "src/scene/validate.h"
#include "tools/animate/film.h"
#include "tools/animate/sheet.h"
#include "tools/cli/errors.h"
#include "tools/cli/process.h"
#include "tools/job/exr_format.h"

namespace strata::tools::animate {

namespace fs = std::filesystem;

namespace {

constexpr const char* kExtensions = ".exr, .png, .tif or .jpg for frames, .mp4, .webm or .gif for films";

// What the paper's animations compare, of the built-in scenes that are made for them.
std::string default_columns(const cli::LoadedScene& loaded) {
    const scene::Sampling& sampling = loaded.scene.sampling;
    if (loaded.source == "isosurface") {
        return fmt::format("none label=\"no antialiasing\"; scene label=\"in space and time: m = {}, l = {}, N = {}\"",
                           sampling.m, sampling.time_order, sampling.N);
    }
    if (loaded.source == "wheel") return "l=1 label=\"box in time (l = 1)\"; l=4 label=\"cubic in time (l = 4)\"";
    return {};
}

std::string choose_columns(const Request& request, const cli::LoadedScene& loaded) {
    const bool has_sides = !request.left.empty() || !request.right.empty();
    if (!request.columns.empty() && has_sides) {
        throw cli::UsageError("--columns: allowed: without --left and --right, which are another way to say it");
    }
    if (!request.columns.empty()) return request.columns;
    if (!has_sides) return default_columns(loaded);
    const std::string left = request.left.empty() ? "none" : request.left;
    const std::string right = request.right.empty() ? "scene" : request.right;
    job::parse_column("--left", left);
    job::parse_column("--right", right);
    return left + "; " + right;
}

void check_columns(const Job& job) {
    const scene::Scene& base = job.scene;
    for (const job::ColumnSettings& column : job.columns) {
        const scene::Scene scene = job::with_settings(base, column, "--columns");
        const bool same_frame = scene.film.width == base.film.width && scene.film.height == base.film.height;
        const bool same_time = scene.shutter.fps == base.shutter.fps && scene.shutter.frame == base.shutter.frame;
        if (same_frame && same_time) continue;
        throw cli::UsageError(
            fmt::format("--columns '{}': allowed: the same film.width, film.height, shutter.fps and shutter.frame for "
                        "all columns; --size and --frames set them",
                        scene::excerpt(column.text)));
    }
}

bool is_png(const FrameOutput& output) { return image::extension_of(output.pattern.path(0)) == ".png"; }

void add_output(Job& job, const fs::path& typed) {
    if (!typed.has_filename()) throw cli::UsageError(fmt::format("-o {}: names no file", typed.string()));
    if (image::stream_target(typed)) {
        throw cli::UsageError(fmt::format(
            "-o {}: allowed: files; frames are numbered ones, and films are put in place whole", typed.string()));
    }
    if (is_film(typed)) {
        const auto is_same = [&](const fs::path& film) { return image::is_one_file(film, typed); };
        if (std::ranges::none_of(job.films, is_same)) job.films.push_back(typed);
        return;
    }
    try {
        image::format_of(typed);
        if (!job.columns.empty()) image::check_canvas_format(typed);
        image::check_size(typed, job.width, job.height);
    } catch (const image::ImageError& error) {
        if (job.columns.empty()) throw cli::UsageError(fmt::format("{} (allowed: {})", error.what(), kExtensions));
        throw cli::UsageError(
            fmt::format("{} (of pictures side by side: .png, .tif or .jpg, .mp4, .webm or .gif)", error.what()));
    }
    FrameOutput output{.pattern = FramePattern(typed)};
    const auto is_same = [&](int frame) {
        return std::ranges::any_of(job.frames, [&](const FrameOutput& other) {
            return image::is_one_file(other.pattern.path(frame), output.pattern.path(frame));
        });
    };
    if (is_same(job.range.first()) && is_same(job.range.last())) return;
    if (is_same(job.range.first()) || is_same(job.range.last())) {
        throw cli::UsageError(
            fmt::format("-o {}: allowed: files of its own; some frames of another -o are the same", typed.string()));
    }
    job.frames.push_back(std::move(output));
}

// Films are made of PNG frames: those asked for, or some in a folder beside the first film (frames_folder.h), which
// stays when the animation is interrupted.
void choose_film_source(Job& job) {
    if (job.films.empty()) return;
    const auto found = std::ranges::find_if(job.frames, is_png);
    job.film_source = static_cast<std::size_t>(found - job.frames.begin());
}

// What its format does not hold, too: the last frame's number is the longest.
void check_frame(const Job& job, const fs::path& path, int frame) {
    image::check_replaceable(path);
    try {
        image::check_encodable(path, frame_shape(job), frame_metadata(job, frame), job.write);
    } catch (const image::ImageError& error) {
        throw cli::UsageError(error.what());
    }
}

void check_paths(const Job& job) {
    for (const fs::path& film : job.films) {
        check_timing(film, job.range, job.scene.shutter.fps);
        image::check_replaceable(film);
    }
    for (const FrameOutput& output : job.frames) {
        for (const int frame : {job.range.first(), job.range.last()})
            check_frame(job, output.pattern.path(frame), frame);
    }
    if (!job.films.empty()) cli::find_program("ffmpeg", "ffmpeg", "video");
}

// Every frame has its own time: what is within reach of one may not be of another.
void check_scenes(const Job& job) {
    for (const int frame : job.range) {
        for (const job::PictureJob& picture : frame_pictures(job, frame)) {
            scene::validate(picture.scene, fmt::format("frame {}", frame));
        }
    }
}

void choose_size(Job& job) {
    job.width = job.scene.film.width;
    job.height = job.scene.film.height;
    if (job.columns.empty()) return;
    image::check_fonts();
    const image::Picture blank = image::make_picture(job.width, job.height);
    const image::Canvas sheet = side_by_side(job.columns, std::vector(job.columns.size(), image::to_canvas(blank)));
    job.width = sheet.width;
    job.height = sheet.height;
}

}  // namespace

Job prepare_animation(const cli::LoadedScene& loaded, const Request& request) {
    Job job;
    job.overwrite = request.overwrite;
    job.quiet = request.quiet;
    job.threads = request.threads;
    job.tracer = request.tracer;
    job.scene = loaded.scene;
    job.write = {.colour = image::colour_out(job.scene.film), .exr_format = request.format};
    if (!job.quiet) job.write.warn = job::warn_of_clipping;
    job.range = request.frames.empty() ? default_frames(job.scene) : parse_frames(request.frames);
    job.scene.shutter.frame = job.range.first();
    job.columns_text = choose_columns(request, loaded);
    if (!job.columns_text.empty()) job.columns = job::parse_columns("--columns", job.columns_text);
    check_columns(job);
    check_scenes(job);
    choose_size(job);
    const std::vector<std::string> outputs =
        request.outputs.empty() ? std::vector<std::string>{loaded.name + ".mp4"} : request.outputs;
    for (const std::string& output : outputs) add_output(job, output);
    choose_film_source(job);
    check_paths(job);
    return job;
}

void add_scratch_frames(Job& job, const fs::path& folder) {
    job.frames.push_back({.pattern = FramePattern(folder / "frame.####.png"), .is_scratch = true});
}

std::vector<job::PictureJob> frame_pictures(const Job& job, int frame) {
    scene::Scene scene = job.scene;
    scene.shutter.frame = frame;
    if (job.columns.empty()) return {job::whole_frame(scene, job.tracer)};
    std::vector<job::PictureJob> pictures;
    for (const job::ColumnSettings& column : job.columns) {
        pictures.push_back(
            job::whole_frame(job::with_settings(scene, column, fmt::format("frame {}: --columns", frame)), job.tracer));
    }
    return pictures;
}

image::Metadata frame_metadata(const Job& job, int frame) {
    scene::Scene scene = job.scene;
    scene.shutter.frame = frame;
    image::Metadata metadata = job::whole_frame(scene, job.tracer).metadata(job::name_of(job.write.exr_format));
    if (!job.columns.empty()) metadata.set("strata:columns", job.columns_text);
    return metadata;
}

image::PictureShape frame_shape(const Job& job) { return {job.width, job.height, 0, 0, job.width, job.height}; }

}  // namespace strata::tools::animate
