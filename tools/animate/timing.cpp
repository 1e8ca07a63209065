#include "tools/animate/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/image/format.h"
#include "tools/animate/film.h"
#include "tools/cli/errors.h"

namespace strata::tools::animate {

namespace fs = std::filesystem;

namespace {

constexpr int kLeastDelay_cs = 2;        // players slow down what is quicker
constexpr double kMostDelay_cs = 65535;  // 16 bits
constexpr double kMostWebmRate = 500;    // WebM's times are whole milliseconds

bool is_gif(const fs::path& film) { return image::extension_of(film) == ".gif"; }

// Where frame i of a GIF begins, as its file says it.
int begin_cs(const scene::Rate& rate, int i) { return static_cast<int>(std::lround(100.0 * rate.seconds(i))); }

// Every how many frames one is shown.
int gif_step(const scene::Rate& rate) {
    return std::max(1, static_cast<int>(std::ceil(static_cast<double>(rate) * kLeastDelay_cs / 100.0 - 1e-12)));
}

FilmTiming gif_timing(const FrameList& frames, const scene::Rate& rate) {
    const int step = gif_step(rate);
    FilmTiming timing{.frames = {}, .rate = rate.every(step)};
    const int end_cs = std::max(kLeastDelay_cs, begin_cs(rate, frames.count()));
    for (int i = 0; i < frames.count(); i += step) {
        // A last frame that would be too short leaves its time to the one before.
        if (i > 0 && end_cs - begin_cs(rate, i) < kLeastDelay_cs) break;
        timing.frames.push_back(*(frames.begin() + i));
        timing.last_delay_cs = end_cs - begin_cs(rate, i);
    }
    timing.seconds = end_cs / 100.0;
    return timing;
}

}  // namespace

FilmTiming film_timing(const fs::path& film, const FrameList& frames, const scene::Rate& rate) {
    const scene::Rate shown = rate.every(frames.step().value_or(1));
    if (is_gif(film)) return gif_timing(frames, shown);
    return {.frames = {frames.begin(), frames.end()}, .rate = shown, .seconds = shown.seconds(frames.count())};
}

void check_timing(const fs::path& film, const FrameList& frames, const scene::Rate& rate) {
    if (!frames.step()) {
        throw cli::UsageError(
            fmt::format("-o {}: of unevenly spread frames a film would not play in time; allowed: frames FIRST-LAST or "
                        "FIRST-LASTxSTEP, or pictures",
                        film.string()));
    }
    const double shown = rate.every(*frames.step());
    const double least = is_gif(film) ? 100.0 / kMostDelay_cs : 0.0;
    if (shown < least) {
        throw cli::UsageError(
            fmt::format("-o {}: {:g} frames/s, allowed in a GIF: {:.2g} or more, a frame lasts {:.0f} s at most",
                        film.string(), shown, least, kMostDelay_cs / 100.0));
    }
    if (image::extension_of(film) == ".webm" && shown > kMostWebmRate) {
        throw cli::UsageError(
            fmt::format("-o {}: {:g} frames/s, allowed in WebM: up to {:g}, its times are milliseconds", film.string(),
                        shown, kMostWebmRate));
    }
}

std::string described(const FilmTiming& timing, const FrameList& frames) {
    const std::size_t count = timing.frames.size(), all = static_cast<std::size_t>(frames.count());
    const std::string time = fmt::format("{:g} s", timing.seconds);
    if (count == all) return fmt::format("{} frames, {}", count, time);
    return fmt::format("{} of {} frames, {}: a GIF shows up to {} a second", count, all, time, 100 / kLeastDelay_cs);
}

}  // namespace strata::tools::animate
