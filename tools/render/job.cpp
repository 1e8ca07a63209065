#include "tools/render/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "noise/simd_target.h"
#include "src/image/file_paths.h"
#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/output_file.h"
#include "src/image/picture_metadata.h"
#include "src/image/read.h"
#include "src/image/stream_target.h"
#include "src/image/text.h"
#include "src/parallel/processors.h"
#include "src/scene/key_text.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/standard_output.h"
#include "tools/job/exr_format.h"
#include "tools/job/shard_text.h"
#include "tools/render/layers.h"

namespace strata::tools::render {

namespace {

namespace fs = std::filesystem;

// An option given here, else what the picture that is rendered again recorded, else the default.
std::string choose(const std::string& given, const std::optional<std::string>& recorded, const char* otherwise) {
    return !given.empty() ? given : recorded.value_or(otherwise);
}

constexpr const char* kFormats = "half, float; exr, png, tif, jpg of a pipe or standard output";

// What --format says of EXR channels; nothing where it names the format of a stream.
std::string channels_format(const RenderRequest& request) {
    return image::known_format("." + request.format) ? "" : request.format;
}

// A stream whose name does not tell its format gets that of --format in front: "png:-".
fs::path with_format(const fs::path& path, const std::string& format) {
    const auto stream = image::stream_target(path);
    if (!stream || stream->format || !image::known_format("." + format)) return path;
    return format + ":" + path.string();
}

void check_stream_format(const RenderRequest& request) {
    const auto is_stream = [](const std::string& path) { return image::stream_target(path).has_value(); };
    if (!image::known_format("." + request.format) || std::ranges::any_of(request.outputs, is_stream)) return;
    throw cli::UsageError(
        fmt::format("--format {}: allowed with -o - or a pipe; a file's extension tells its format", request.format));
}

// Bits depend on the SIMD target: a picture is rendered again on its own, where that is here.
void choose_simd_target(const RenderRequest& request, const cli::LoadedScene& loaded) {
    if (request.is_simd_pinned || !loaded.simd_target || noise::pin_simd_target(*loaded.simd_target) || request.quiet)
        return;
    cli::print_error(
        fmt::format("warning: {} was made with --simd {}, which this machine lacks; with {} it may differ by rounding",
                    loaded.source, *loaded.simd_target, noise::simd_target()));
}

constexpr strata::render::PassWords kPassWords{"--passes", "--target-rmse", "--time-limit",
                                               "a smaller --size, or the frame in parts by --crop"};

strata::render::PassGoal choose_goal(const RenderRequest& request, const cli::LoadedScene& loaded) {
    const scene::EstimatorKind estimator = loaded.scene.sampling.estimator;
    strata::render::PassRequest asked{request.passes, request.target_rmse, request.time_limit_s};
    // A picture rendered again with another estimator may have lost its use for passes.
    if (!asked.passes && !asked.is_open_ended() && loaded.passes && strata::render::passes_differ(estimator)) {
        asked.passes =
            cli::parse_integer((loaded.source + ": its strata:passes"), *loaded.passes, 1, strata::render::kMostPasses);
    }
    return strata::render::goal_of(asked, estimator, kPassWords);
}

// What the renderer refuses is a command line that cannot be used.
template <class Action>
auto as_usage(const Action& action) {
    try {
        return action();
    } catch (const std::invalid_argument& error) {
        throw cli::UsageError(error.what());
    }
}

void check_output(const fs::path& path, const Job& job) {
    try {
        image::format_of(path);
        image::check_size(path, job.picture.window.width(), job.picture.window.height());
    } catch (const image::ImageError& error) {
        throw cli::UsageError(error.what());
    }
    if (image::stream_target(path)) return image::check_writable(path);
    if (image::is_one_file(path, job.loaded.source) && !image::is_picture(path)) {
        throw cli::UsageError(fmt::format("{}: this output is the scene file itself", path.string()));
    }
    image::check_writable(path);
}

// Each file once, however often and by whatever name it was asked for.
std::vector<fs::path> output_paths(const RenderRequest& request, const Job& job) {
    const std::string& name = job.loaded.name;
    std::vector<fs::path> asked;
    for (const std::string& typed : request.outputs) asked.push_back(with_format(typed, request.format));
    if (asked.empty() && job.shard) {
        const film::Shard shard = job.shard->shard();
        asked = {fmt::format("{}.{}-of-{}.exr", name, shard.number, shard.count)};
    }
    if (asked.empty()) asked = {name + ".exr", name + ".png"};
    std::vector<fs::path> paths;
    for (const fs::path& path : asked) {
        check_output(path, job);
        if (std::ranges::none_of(paths, [&](const fs::path& other) { return image::is_one_file(path, other); })) {
            paths.push_back(path);
        }
    }
    if (std::ranges::count_if(paths, image::is_standard_output) > 1) {
        throw cli::UsageError("-o: two pictures for standard output, allowed: one");
    }
    return paths;
}

// Its files are EXRs, from which the whole is put together.
void choose_shard(const RenderRequest& request, Job& job) {
    if (request.shard.empty()) return;
    const film::Shard shard = job::parse_shard(request.shard);
    const std::int64_t blocks = film::ShardDeal(job.picture.window, 1).blocks();
    if (shard.count > blocks) {
        throw cli::UsageError(
            fmt::format("--shard {}: the picture has {} blocks of {}x{} pixels, allowed: as many shards", request.shard,
                        blocks, film::kShardBlock, film::kShardBlock));
    }
    if (job.goal.target_rmse > 0 || job.goal.time_limit_s > 0) {
        throw cli::UsageError(
            fmt::format("--shard {}: allowed with --passes; an error or a time to stop at is that of the whole picture",
                        request.shard));
    }
    job.shard.emplace(job.picture.window, shard);
    job.write.exr_layout = image::ExrLayout::tiles;
}

void check_shard_outputs(const Job& job) {
    if (!job.shard) return;
    for (const fs::path& path : job.outputs) {
        if (image::format_of(path) == image::Format::exr) continue;
        throw cli::UsageError(fmt::format("-o {}: allowed with --shard: .exr", path.string()));
    }
}

void check_aov_paths(const Job& job) {
    for (const integrate::Channel* aov : drawn_aovs(job)) {
        const fs::path path = aov_path(job, *aov);
        image::check_writable(path);
        if (std::ranges::any_of(job.outputs,
                                [&](const fs::path& output) { return image::is_one_file(path, output); })) {
            throw cli::UsageError(
                fmt::format("-o {}: allowed: another name, this is where --aov {} goes", path.string(), aov->name));
        }
    }
}

void check_statistics(const Job& job) {
    if (job.statistics.empty()) return;
    image::check_replaceable(job.statistics);
    const auto is_statistics = [&](const fs::path& path) {
        if (image::is_standard_output(path) && image::is_standard_output(job.statistics)) return true;
        return image::is_one_file(path, job.statistics);
    };
    if (is_statistics(job.loaded.source) || std::ranges::any_of(job.outputs, is_statistics)) {
        throw cli::UsageError(fmt::format("--stats {}: allowed: a file of its own", job.statistics.string()));
    }
}

// All that is written, as it was asked for.
std::vector<cli::NamedOutput> named_outputs(const Job& job) {
    std::vector<cli::NamedOutput> outputs;
    for (const fs::path& path : job.outputs) outputs.push_back({fmt::format("-o {}", path.string()), path});
    for (const integrate::Channel* aov : drawn_aovs(job)) {
        outputs.push_back({fmt::format("--aov {}", aov->name), aov_path(job, *aov)});
    }
    for (const LayerFile& file : job.layer_files) {
        outputs.push_back({fmt::format("--aov {}", file.layer.channel->name), file.path});
    }
    if (!job.statistics.empty())
        outputs.push_back({fmt::format("--stats {}", job.statistics.string()), job.statistics});
    return outputs;
}

// The folders of links may differ from that of the output.
void check_partial_paths(const Job& job) {
    for (const cli::NamedOutput& output : named_outputs(job)) {
        if (output.path == job.statistics || image::stream_target(output.path)) continue;
        image::check_writable(partial_path(job, output.path));
    }
}

// What a format does not hold, though the number of passes were the longest.
void check_limits(const Job& job) {
    for (const fs::path& path : job.outputs) {
        try {
            image::check_encodable(path, job.shape(), final_metadata(job, job.goal.passes, true), job.write);
        } catch (const image::ImageError& error) {
            throw cli::UsageError(error.what());
        }
    }
}

}  // namespace

fs::path aov_path(const Job& job, const integrate::Channel& aov) {
    const bool is_stream = image::stream_target(job.outputs.front()).has_value();
    const fs::path path = is_stream ? fs::path(job.loaded.name + ".png") : job.outputs.front();
    return image::derived_path(path, fmt::format(".{}.png", aov.name));
}

fs::path partial_path(const Job& job, const fs::path& path) {
    const std::vector<cli::NamedOutput> outputs = named_outputs(job);
    for (int i = 1;; ++i) {
        const std::string count = i == 1 ? "" : fmt::format("-{}", i);
        fs::path partial = image::derived_path(path, fmt::format(".partial{}{}", count, path.extension().string()));
        const auto is_it = [&](const cli::NamedOutput& output) { return image::is_one_file(output.path, partial); };
        if (std::ranges::none_of(outputs, is_it)) return partial;
    }
}

image::Metadata final_metadata(const Job& job, int passes, bool is_partial) {
    image::Metadata metadata = job.metadata;
    image::set_passes(metadata, job.picture.scene.sampling, passes);
    if (!is_partial) return metadata;
    metadata.set("strata:partial", passes == 0 ? "unfinished pixels are black"
                                               : fmt::format("the mean of {} whole passes; more were wanted", passes));
    return metadata;
}

image::PictureShape Job::shape() const {
    if (!shard) return picture.shape();
    return {shard->window().x1, shard->window().y1, 0, 0, shard->window().x1, shard->window().y1};
}

Job prepare(const RenderRequest& request) {
    Job job;
    job.quiet = request.quiet;
    job.threads = request.threads;
    job.tile = request.tile;
    job.loaded = request.scene.load();
    choose_simd_target(request, job.loaded);
    job.picture = {job.loaded.scene, cli::window_of(request.crop, job.loaded),
                   cli::tracer_of(request.tracer, job.loaded)};
    check_stream_format(request);
    const std::string format = choose(channels_format(request), job.loaded.exr_format, "half");
    const bool is_tiled = request.tiled || job.loaded.is_tiled;
    job.write = {.colour = image::colour_out(job.loaded.scene.film),
                 .exr_format = job::parse_exr_format(format, kFormats),
                 .exr_layout = is_tiled ? image::ExrLayout::tiles : image::ExrLayout::automatic,
                 .frames_per_second = image::frame_rate(job.loaded.scene)};
    if (!request.quiet) job.write.warn = job::warn_of_clipping;
    job.goal = as_usage([&] { return choose_goal(request, job.loaded); });
    choose_shard(request, job);
    choose_aovs(request, job);
    as_usage([&] {
        strata::render::check_memory(job.goal, estimate::estimator_settings(job.loaded.scene), job.rendered_window(),
                                     parallel::available_memory_bytes(), kPassWords);
    });
    job.outputs = output_paths(request, job);
    check_shard_outputs(job);
    choose_layer_files(job);
    check_aov_paths(job);
    job.statistics = request.statistics;
    check_statistics(job);
    cli::refuse_shared(named_outputs(job));
    check_partial_paths(job);
    for (const fs::path& path : job.outputs) cli::keep_output_for(path);
    cli::keep_output_for(job.statistics);
    job.metadata = job.picture.metadata(format);
    if (is_tiled) job.metadata.set("strata:tiled", "asked for");
    if (!job.aovs.empty()) set_aovs(job, job.metadata);
    if (job.shard) job.metadata.set(job::kShardKey, job::shard_text(job.shard->shard()));
    check_limits(job);
    job.journal = request.journal;
    job.journal.threads = job.threads > 0 ? job.threads : parallel::available_processors();
    return job;
}

}  // namespace strata::tools::render
