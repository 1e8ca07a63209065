// An animation as the command line asks for it, checked before the first ray.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "src/image/encode.h"
#include "src/scene/scene.h"
#include "tools/animate/frames.h"
#include "tools/animate/range.h"
#include "tools/cli/scene_argument.h"
#include "tools/job/column_settings.h"

namespace strata::tools::animate {

// The options as typed; empty where there is none.
struct AnimateRequest {
    cli::SceneArgument scene;
    std::vector<std::string> outputs;
    std::string frames, columns, left, right, tracer = "fast", simd, format, threads = "0";
    bool overwrite = false, quiet = false;
};

// One file of each frame.
struct FrameOutput {
    FramePattern pattern;
    bool is_scratch = false;  // for a film alone: its own, in a FramesFolder, replaced and removed
};

struct AnimateJob {
    scene::Scene scene;
    std::vector<job::ColumnSettings> columns;  // side by side, with labels; empty: the scene alone
    std::string columns_text;                  // all of them as typed
    FrameList range;
    std::vector<FrameOutput> frames;
    std::vector<std::filesystem::path> films;
    std::size_t film_source = 0;  // which of `frames` films are made of
    image::WriteOptions write;
    std::string tracer, format;
    int threads = 0;
    int width = 0, height = 0;  // of a frame's file
    bool overwrite = false, quiet = false;
};

// Throws UsageError or SceneError for what cannot be asked for, ImageError for outputs that cannot be written,
// ProcessError when ffmpeg is wanted and missing.
AnimateJob prepare_animation(const AnimateRequest& request);

// Whether films are made of frames that nobody asked for.
inline bool has_scratch_frames(const AnimateJob& job) {
    return !job.films.empty() && job.film_source == job.frames.size();
}

// Puts these into a folder.
void add_scratch_frames(AnimateJob& job, const std::filesystem::path& folder);

// The scenes of a frame's pictures, one a column.
std::vector<scene::Scene> frame_scenes(const AnimateJob& job, int frame);

// What a frame's file says of itself.
image::Metadata frame_metadata(const AnimateJob& job, int frame);

}  // namespace strata::tools::animate
