// Options that several commands have, each declared once.
#pragma once

#include <optional>
#include <string>

#include "src/integrate/surface_image.h"
#include "tools/cli/command_line.h"

namespace strata::tools::cli {

// How a command works: --threads and --quiet.
struct Working {
    int threads = 0;     // 0: as many as machine and container give
    bool quiet = false;  // neither progress, summary nor warnings
};
void add_working(Command& command, Working& working);

void add_threads(Command& command, int& threads);
void add_quiet(Command& command, bool& quiet, const char* meaning = "No progress, summary or warnings");

// --simd pins the target, and says so.
void add_simd(Command& command, bool* is_pinned = nullptr);

// --tracer, fast where it is not given.
void add_tracer(Command& command, integrate::Tracer& tracer);
// The same, with the default that the command finds.
void add_tracer(Command& command, std::optional<integrate::Tracer>& tracer);

// --crop, which is read when the frame is known: window_of().
void add_crop(Command& command, std::string& crop, const char* what = "Render");

// "fast" or "reference". Throws UsageError.
integrate::Tracer parse_tracer(const std::string& name);
const char* name_of(integrate::Tracer tracer);

}  // namespace strata::tools::cli
