// A picture, or frames of an animation, cut into tasks that machines do apart: all that is decided before the first.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/render/job.h"

namespace strata::tools::farm {

inline constexpr int kMostTasks = 1000;  // of an array, as Slurm comes: MaxArraySize is 1001

// As the command line asks for it; empty or 0 where an option is not given.
struct Request {
    render::RenderRequest picture;  // its scene, the options of its pixels, and the threads of a task
    std::string output, frames, folder, engine = "slurm", hosts;
    std::vector<std::string> sbatch;
    int shards = 0;
};

struct Plan {
    std::string title;                  // for people: what is rendered
    std::filesystem::path output;       // absolute
    std::filesystem::path folder;       // absolute
    std::string scene;                  // frozen: the text of scene.toml
    std::vector<std::string> commands;  // for a shell in the folder; the last one joins what the others made
    std::filesystem::path program;
    std::string simd;

    int tasks() const { return static_cast<int>(commands.size()) - 1; }
};

// Throws UsageError or SceneError for what cannot be asked for, ImageError for outputs that cannot be written.
Plan make_plan(const Request& request);

}  // namespace strata::tools::farm
