// A render as the command line asks for it, checked and completed before the first ray.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/film/shard.h"
#include "src/image/encode.h"
#include "src/image/metadata.h"
#include "src/render/progressive.h"
#include "tools/cli/scene_argument.h"
#include "tools/job/aov.h"
#include "tools/job/picture_job.h"
#include "tools/job/work_journal.h"
#include "tools/render/layer_files.h"

namespace strata::tools::render {

// The options; empty where there is none.
struct RenderRequest {
    cli::SceneArgument scene;
    std::vector<std::string> outputs;
    std::string crop, format, statistics, aov, layers, layer_prefix, shard;
    std::optional<integrate::Tracer> tracer;
    std::optional<int> passes;
    double target_rmse = 0, time_limit_s = 0;
    job::JournalOptions journal;
    int threads = 0, tile = 32;
    bool is_simd_pinned = false, quiet = false, tiled = false;
};

// Those of the options that say what the pixels of one picture are and how an EXR keeps them, for all commands that
// have it rendered.
void add_picture_options(cli::Command& command, RenderRequest& request);

// All that is known before the first ray.
struct Job {
    cli::LoadedScene loaded;
    job::PictureJob picture;
    std::optional<film::ShardPicture> shard;  // of its window, which alone is rendered; empty: all of it
    std::vector<std::filesystem::path> outputs;
    integrate::ChannelSet aovs;
    std::string layers, layer_prefix;
    std::vector<LayerFile> layer_files;  // of AOVs that are asked for in files of their own
    std::filesystem::path statistics;    // empty: none
    image::WriteOptions write;
    image::Metadata metadata;
    strata::render::PassGoal goal;
    job::JournalOptions journal;
    int threads = 0, tile = 0;
    bool quiet = false;

    // What is rendered, and its place in its frame: a shard is a frame of its own.
    film::Rect rendered_window() const { return shard ? shard->window() : picture.window; }
    image::PictureShape shape() const;
};

// Throws UsageError or SceneError for what cannot be asked for, ImageError for outputs that cannot be written.
Job prepare(const RenderRequest& request);

// NAME.steps.png, named like the first output: the picture of an AOV to look at.
std::filesystem::path aov_path(const Job& job, const integrate::Channel& aov);

// Where what is finished of an output goes when the render is stopped: NAME.partial.EXT beside NAME.EXT, or
// NAME.partial-2.EXT where that is an output itself.
std::filesystem::path partial_path(const Job& job, const std::filesystem::path& path);

// All that a picture of `passes` passes says of itself, one that was stopped if `is_partial`.
image::Metadata final_metadata(const Job& job, int passes, bool is_partial);

}  // namespace strata::tools::render
