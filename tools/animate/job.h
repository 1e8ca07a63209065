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
#include "tools/job/picture_job.h"

namespace strata::tools::animate {

// The options; empty where there is none.
struct Request {
    std::vector<std::string> outputs;
    std::string frames, columns, left, right;
    integrate::Tracer tracer = integrate::Tracer::fast;
    image::ExrFormat format = image::ExrFormat::half;
    int threads = 0;
    bool overwrite = false, quiet = false;
};

// One file of each frame.
struct FrameOutput {
    FramePattern pattern;
    bool is_scratch = false;  // for a film alone: its own, in a FramesFolder, replaced and removed
};

struct Job {
    scene::Scene scene;
    std::vector<job::ColumnSettings> columns;  // side by side, with labels; empty: the scene alone
    std::string columns_text;                  // all of them as typed
    FrameList range;
    std::vector<FrameOutput> frames;
    std::vector<std::filesystem::path> films;
    std::size_t film_source = 0;  // which of `frames` films are made of
    image::WriteOptions write;
    integrate::Tracer tracer = integrate::Tracer::fast;
    int threads = 0;
    int width = 0, height = 0;  // of a frame's file
    bool overwrite = false, quiet = false;
};

// Throws UsageError or SceneError for what cannot be asked for, ImageError for outputs that cannot be written,
// ProcessError when ffmpeg is wanted and missing.
Job prepare_animation(const cli::LoadedScene& loaded, const Request& request);

// Whether films are made of frames that nobody asked for.
inline bool has_scratch_frames(const Job& job) { return !job.films.empty() && job.film_source == job.frames.size(); }

// Puts these into a folder.
void add_scratch_frames(Job& job, const std::filesystem::path& folder);

// A frame's pictures, one a column.
std::vector<job::PictureJob> frame_pictures(const Job& job, int frame);

// What a frame's file says of itself.
image::Metadata frame_metadata(const Job& job, int frame);

image::PictureShape frame_shape(const Job& job);

}  // namespace strata::tools::animate
