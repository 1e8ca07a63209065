// Making figures: rendering their parts with progress over all of them, drawing them, and writing what they are.
#pragma once

#include <filesystem>
#include <vector>

#include "src/parallel/cancel.h"
#include "tools/figures/figure.h"

namespace strata::tools::figures {

struct MakeOptions {
    std::filesystem::path folder;
    Size size = Size::paper;
    int threads = 0;
    bool quiet = false;
    bool overwrite = false;
};

// Thrown when the token was cancelled: what is finished stays.
struct Interrupted {};

// "figure-6.json" (record.h).
std::filesystem::path record_path(const std::filesystem::path& folder, int number);

// All that will be in the folder of it, its record included.
std::vector<std::filesystem::path> paths_of(const Figure& figure, const MakeOptions& options);

// Whether the figure is there already, whole and as this plan would make it. Tells what is damaged unless quiet.
bool is_made(const MakeOptions& options, const Plan& plan);

// Plans every figure, renders, draws. Figures that are made already are kept unless they are plots or
// options.overwrite. Prints a line a figure unless quiet. What keeps a figure from being made or written is told, and
// the others are made: false then. Throws SceneError, before anything is rendered, and Interrupted.
bool make_figures(const std::vector<Figure>& figures, const MakeOptions& options, const parallel::CancelToken& cancel);

}  // namespace strata::tools::figures
