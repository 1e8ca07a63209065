// What a render did and cost: the summary on the terminal and the --stats file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "src/render/progressive.h"
#include "src/render/render.h"

namespace strata::tools::render {

// Of a render in passes.
struct PassStatistics {
    strata::render::PassGoal goal;
    int passes = 0;
    strata::render::PassesEnd end = strata::render::PassesEnd::passes;
    std::optional<strata::render::ErrorEstimate> error;
    std::optional<int> predicted_passes;
    double predicted_seconds = 0;
};

struct RunStatistics {
    integrate::Counters counters;
    double seconds = 0.0;  // tracing, shading, filtering, and pictures written meanwhile; not set-up
    double cpu_seconds = 0.0;
    int threads = 0;
    std::string simd_target;
    std::uint64_t peak_memory_bytes = 0;
    std::string scene;
    std::string settings_mark{};           // settings_mark.h; empty: not written
    std::optional<PassStatistics> passes;  // empty: a plain render
};

RunStatistics collect(const strata::render::RenderResult& result, const std::string& scene);
RunStatistics collect(const strata::render::ProgressiveResult& result, const strata::render::PassGoal& goal,
                      const std::string& scene);

// A few lines for people.
std::string summary(const RunStatistics& statistics);

// The --stats file.
std::string statistics_json(const RunStatistics& statistics);

}  // namespace strata::tools::render
