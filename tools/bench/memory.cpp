#include "tools/bench/memory.h"

#include <fmt/format.h>

#include <chrono>

#include "tools/bench/own_folder.h"
#include "tools/cli/process.h"
#include "tools/cli/temporary_folder.h"

namespace strata::tools::bench {

namespace {

MemoryResult render_alone(const char* id, int width, int height) {
    MemoryResult row{.id = id, .width = width, .height = height};
    const cli::TemporaryFolder scratch("bench");
    const auto start = std::chrono::steady_clock::now();
    try {
        const cli::ProgramRun run = cli::run_program(
            own_folder() / "strata", {"render", "hyperterrain", "--size", fmt::format("{}x{}", width, height), "-N",
                                      "1", "--quiet", "-o", (scratch.path() / "out.exr").string()});
        row.peak_bytes = run.peak_memory_bytes;
    } catch (const cli::ProcessError& error) {
        row.failure = error.what();
    }
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return row;
}

}  // namespace

std::vector<MemoryResult> measure_memory(bool quick, const parallel::CancelToken& cancel) {
    std::vector<MemoryResult> rows{render_alone(kMemoryUsual, 1920, 1080)};
    if (!quick && !cancel.requested()) rows.push_back(render_alone(kMemoryHuge, 16384, 16384));
    return rows;
}

}  // namespace strata::tools::bench
