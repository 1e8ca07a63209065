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

inline constexpr int kMostZoom = 64;

// The options; empty where there is none.
struct Request {
    cli::SceneArgument scene;
    bool has_scene = false;
    std::vector<std::string> pictures;
    std::string columns, crop, labels, reference, top, output;
    std::optional<int> zoom;
    int threads = 0;
    std::optional<std::string> title, caption;
    bool difference = false, rmse = false, parts = false, quiet = false;
};

// One picture of the strip, or the reference it is compared with: read from a file or to be rendered.
struct Source {
    std::string name;  // for messages: a path, or settings as typed
    std::string label;
    std::filesystem::path file;         // empty: to be rendered
    std::optional<scene::Scene> scene;  // that it is, or was, rendered from
    image::Picture picture;             // linear; empty until it is rendered
};

struct Job {
    std::vector<Source> columns;
    std::optional<Source> reference;              // where it is no column
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
Job prepare_strip(const Request& request);

// Where part `i`, counted from 0, is written: strip.png -> strip-1.exr, the reference strip-reference.exr.
std::filesystem::path part_path(const Job& job, std::optional<std::size_t> i);

// All that is written: the strip, then its parts, if they are asked for.
std::vector<std::filesystem::path> strip_files(const Job& job);

}  // namespace strata::tools::strip
