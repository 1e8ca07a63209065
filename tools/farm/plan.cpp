#include "tools/farm/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "noise/simd_target.h"
#include "src/scene/key_text.h"
#include "src/scene/printer.h"
#include "tools/animate/film.h"
#include "tools/animate/job.h"
#include "tools/cli/errors.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/shell_word.h"
#include "tools/job/exr_format.h"

namespace strata::tools::farm {

namespace fs = std::filesystem;

namespace {

constexpr int kUsualShards = 8;
constexpr const char* kSceneFile = "scene.toml";

using Words = std::vector<std::string>;

std::string line_of(const Words& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + cli::shell_word(word);
    return line;
}

Words operator+(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// What every task of a farm is told: whatever machine it comes to, it does the same.
Words working_words(const Request& request, integrate::Tracer tracer) {
    return {"--tracer",  cli::name_of(tracer),
            "--simd",    noise::simd_target(),
            "--threads", fmt::format("{}", std::max(1, request.picture.threads)),
            "--quiet"};
}

// All that a picture's metadata say beside its scene, as options.
Words picture_words(const Request& request, const render::Job& job) {
    const film::Rect& w = job.picture.window;
    Words words = working_words(request, job.picture.tracer) +
                  Words{"--crop",   fmt::format("{},{},{},{}", w.x0, w.y0, w.x1, w.y1),
                        "--format", job::name_of(job.write.exr_format),
                        "--passes", fmt::format("{}", job.goal.passes)};
    if (job.metadata.find("strata:tiled")) words.push_back("--tiled");
    if (!job.aovs.empty()) words = words + Words{"--aov", job::names_of(job.aovs)};
    if (!job.layer_prefix.empty()) words = words + Words{"--layer-prefix", job.layer_prefix};
    return words;
}

std::string title_of(const cli::LoadedScene& loaded, const std::string& what) {
    const scene::Scene& scene = loaded.scene;
    return fmt::format("{}, {}x{}, N = {}, {}", loaded.name, scene.film.width, scene.film.height, scene.sampling.N,
                       what);
}

void plan_shards(const Request& request, Plan& plan) {
    render::RenderRequest picture = request.picture;
    picture.quiet = true;
    picture.outputs = {plan.output.string()};
    const int count = request.shards > 0 ? request.shards : kUsualShards;
    picture.shard = fmt::format("1/{}", count);
    const render::Job job = render::prepare(picture);
    const Words common = picture_words(request, job);
    Words merge{plan.program.string(), "merge", "-o", plan.output.string(), "--quiet"};
    for (int shard = 1; shard <= count; ++shard) {
        const std::string part = fmt::format("parts/{}.exr", shard);
        plan.commands.push_back(
            line_of(Words{plan.program.string(), "render", kSceneFile, "--shard", fmt::format("{}/{}", shard, count)} +
                    Words{"-o", part} + common));
        merge.push_back(part);
    }
    plan.commands.push_back(line_of(merge));
    plan.scene = scene::print_scene(job.loaded.scene, scene::PrintedKeys::all);
    plan.title = title_of(job.loaded, fmt::format("{} shards", count));
}

void refuse_picture_options(const render::RenderRequest& picture) {
    if (picture.crop.empty() && picture.aov.empty() && picture.layer_prefix.empty() && !picture.tiled &&
        !picture.passes)
        return;
    throw cli::UsageError(
        "--frames: allowed without --crop, --aov, --layer-prefix, --tiled and --passes, as of `strata animate`");
}

// Frames that are pictures are where they are wanted at once; those of a film stay in the folder. The last task looks
// at all of them, makes those anew that were damaged since, and a film of them.
void plan_frames(const Request& request, Plan& plan) {
    refuse_picture_options(request.picture);
    cli::LoadedScene loaded = request.picture.scene.load();
    loaded.source = kSceneFile;
    animate::Request animation;
    animation.frames = request.frames;
    animation.outputs = {plan.output.string()};
    animation.quiet = true;
    animation.tracer = cli::tracer_of(request.picture.tracer, loaded);
    if (!request.picture.format.empty()) animation.format = job::parse_exr_format(request.picture.format);
    const animate::Job job = prepare_animation(loaded, animation);
    const Words common = working_words(request, job.tracer) + Words{"--format", job::name_of(animation.format)};
    const bool is_film = animate::is_film(plan.output);
    const std::string pictures = is_film ? "parts/frame.####.png" : plan.output.string();
    const auto command = [&](const Words& frames) {
        return Words{plan.program.string(),
                     "animate",
                     kSceneFile,
                     "--frames",
                     fmt::format("{}", fmt::join(frames, ",")),
                     "-o",
                     pictures} +
               common;
    };
    Words numbers;
    for (const int frame : job.range) numbers.push_back(fmt::format("{}", frame));
    const std::size_t a_task = (numbers.size() + kMostTasks - 1) / kMostTasks;
    for (std::size_t i = 0; i < numbers.size(); i += a_task) {
        const Words some(numbers.begin() + static_cast<std::ptrdiff_t>(i),
                         numbers.begin() + static_cast<std::ptrdiff_t>(std::min(i + a_task, numbers.size())));
        plan.commands.push_back(line_of(command(some)));
    }
    plan.commands.push_back(
        line_of(command({request.frames}) + (is_film ? Words{"-o", plan.output.string()} : Words{})));
    plan.scene = scene::print_scene(loaded.scene, scene::PrintedKeys::all);
    plan.title = title_of(loaded, fmt::format("{} frames", numbers.size()));
}

}  // namespace

Plan make_plan(const Request& request) {
    if (request.shards > 0 && !request.frames.empty()) {
        throw cli::UsageError("--shards: allowed without --frames; frames are tasks of their own");
    }
    if (request.output.find('\n') != std::string::npos) {
        throw cli::UsageError(fmt::format("-o {}: allowed: a name on one line", scene::excerpt(request.output)));
    }
    Plan plan;
    plan.output = fs::absolute(request.output);
    plan.folder = fs::absolute(request.folder.empty() ? request.output + ".farm" : request.folder);
    plan.program = fs::read_symlink("/proc/self/exe");
    if (request.frames.empty())
        plan_shards(request, plan);
    else
        plan_frames(request, plan);
    plan.simd = noise::simd_target();
    return plan;
}

}  // namespace strata::tools::farm
