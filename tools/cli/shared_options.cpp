#include "tools/cli/shared_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "noise/simd_target.h"
#include "src/scene/key_text.h"
#include "tools/cli/errors.h"

namespace strata::tools::cli {

namespace {

constexpr int kMostThreads = 1024;  // each has buffers of its own
constexpr const char* kTracers = "fast, or reference (plain sphere tracing in double)";

void use_simd_target(const std::string& name) {
    if (noise::pin_simd_target(name)) return;
    throw UsageError(fmt::format("--simd {}: allowed on this machine: {}", scene::excerpt(name),
                                 fmt::join(noise::simd_targets(), ", ")));
}

}  // namespace

void add_working(Command& command, Working& working) {
    add_threads(command, working.threads);
    add_quiet(command, working.quiet);
}

void add_threads(Command& command, int& threads) {
    command.add_option("--threads", threads, 0, kMostThreads, "n",
                       "Threads, up to 1024; 0: as many as machine and container give");
}

void add_quiet(Command& command, bool& quiet, const char* meaning) { command.add_flag("--quiet", quiet, meaning); }

void add_simd(Command& command, bool* is_pinned) {
    const auto read = [is_pinned](const std::string& text) {
        use_simd_target(text);
        if (is_pinned != nullptr) *is_pinned = true;
    };
    command.add_option("--simd", read, "TARGET", "avx512, avx2, sse4 or scalar; default the best that is here");
}

void add_tracer(Command& command, integrate::Tracer& tracer) {
    const auto read = [&tracer](const std::string& text) { tracer = parse_tracer(text); };
    command.add_option("--tracer", read, "NAME", kTracers)->default_str(name_of(tracer));
}

void add_tracer(Command& command, std::optional<integrate::Tracer>& tracer) {
    const auto read = [&tracer](const std::string& text) { tracer = parse_tracer(text); };
    command.add_option("--tracer", read, "NAME", fmt::format("{}; default fast", kTracers));
}

void add_crop(Command& command, std::string& crop, const char* what) {
    command.add_option(
        "--crop", crop, "x0,y0,x1,y1",
        fmt::format("{} pixels [x0,x1) x [y0,y1) of the frame alone, y down; default the whole frame", what));
}

integrate::Tracer parse_tracer(const std::string& name) {
    if (name == "fast") return integrate::Tracer::fast;
    if (name == "reference") return integrate::Tracer::reference;
    throw UsageError(fmt::format("--tracer {}: allowed: fast, reference", scene::excerpt(name)));
}

const char* name_of(integrate::Tracer tracer) { return tracer == integrate::Tracer::fast ? "fast" : "reference"; }

}  // namespace strata::tools::cli
