// A comparison strip as the command line asks for it, checked before the first ray.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/image/colour_out.h"
#include "src/image/picture.h"
#include "src/scene/scene.h"
#include "tools/cli/scene_argument.h"

namespace strata::tools::strip {

// The options as typed; empty where there is none.
struct StripRequest {
    cli::SceneArgument scene;
    bool has_scene = false;
    std::vector<std::string> pictures;
    std::string columns, crop, zoom, labels, reference, top, output, simd, threads = "0";
    std::optional<std::string> title, caption;
    bool difference = false, rmse = false, parts = false, quiet = false;
};

// One picture of the strip, or the reference it is compared with: read from a file or to be rendered.
struct StripSource {
    std::string name;  // for messages: a path, or settings as typed
    std::string label;
    std::filesystem::path file;         // empty: to be rendered
    std::optional<scene::Scene> scene;  // that it is, or was, rendered from
    image::Picture picture;             // linear; empty until it is rendered
};

struct StripJob {
    std::vector<StripSource> columns;
    std::optional<StripSource> reference;         // where it is no column
    std::optional<std::size_t> reference_column;  // where it is one
    film::Rect window;                            // of the frame
    int frame_width = 0, frame_height = 0;
    int zoom = 1;
    image::ColourOut colour;
    std::optional<double> top;
    std::string title, caption, scene_text;
    std::filesystem::path output;
    bool difference = false, rmse = false, parts = false, quiet = false;
    int threads = 0;
};

// Reads the pictures too. Throws UsageError or SceneError for what cannot be asked for, ImageError for outputs that
// cannot be written and a missing font.
StripJob prepare_strip(const StripRequest& request);

// Where part `i`, counted from 0, is written: strip.png -> strip-1.exr, the reference strip-reference.exr.
std::filesystem::path part_path(const StripJob& job, std::optional<std::size_t> i);

// All that is written: the strip, then its parts, if they are asked for.
std::vector<std::filesystem::path> strip_files(const StripJob& job);

}  // namespace strata::tools::strip
