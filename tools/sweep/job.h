// A sweep as the command line asks for it, checked before the first ray.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/image/picture.h"
#include "tools/cli/scene_argument.h"
#include "tools/job/picture_folder.h"
#include "tools/sweep/axes.h"

namespace strata::tools::sweep {

inline constexpr int kMostN = 64;  // as sampling.N allows

// The options; empty where there is none.
struct Request {
    cli::SceneArgument scene;
    AxisRequest axes;
    std::string crop, reference = "auto", output;
    std::optional<int> reference_N;
    int threads = 0;
    bool quiet = false;
};

using Picture = job::FolderPicture;

struct Cell {
    std::size_t row = 0, column = 0;
    std::vector<std::pair<std::string, std::string>> settings;  // keys of the axes and their values here
    Picture picture;
    std::size_t reference = 0;  // index
};

// What cells of one filter and one scene are compared with: the mean of two independent pictures.
struct Reference {
    std::string file;   // of the mean
    std::string label;  // "m = 4"; empty where it is the only one
    Picture halves[2];
};

struct Job {
    cli::LoadedScene loaded;
    Axes axes;
    std::vector<Cell> cells;            // row by row
    std::vector<Reference> references;  // --reference auto
    std::optional<image::Picture> given_reference;
    std::string given_reference_name;
    std::filesystem::path folder;
    bool quiet = false;
    int threads = 0;

    std::size_t rows() const { return axes.rows ? axes.rows->values.size() : 1; }
    std::size_t columns() const { return axes.columns ? axes.columns->values.size() : 1; }
};

// Makes the folder. Throws UsageError or SceneError for what cannot be asked for, ImageError for a folder that cannot
// be written to and a missing font.
Job prepare_sweep(const Request& request);

// The names of what else is in the folder.
inline constexpr const char* kSheetFile = "sweep.png";
inline constexpr const char* kCsvFile = "sweep.csv";
inline constexpr const char* kJsonFile = "sweep.json";

}  // namespace strata::tools::sweep
