#include "tools/cli/progress_printer.h"

#include <cmath>
#include <cstdio>

namespace strata::tools::cli {

namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
    char text[96];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace

std::string duration_text(double seconds) {
    const long long whole = std::llround(std::ceil(std::fmin(std::fmax(seconds, 0.0), 1e15)));
    if (whole < 60) return formatted("%lld s", whole);
    if (whole < 3600) return formatted("%lld min %02lld s", whole / 60, whole % 60);
    return formatted("%lld h %02lld min", whole / 3600, whole / 60 % 60);
}

std::string progress_line(const parallel::Progress& progress) {
    std::string line =
        formatted("%3.0f %%, %.3g M rays/s", std::floor(100 * progress.fraction), progress.rays_per_second() / 1e6);
    if (progress.fraction > 0) line += ", " + duration_text(progress.predicted_seconds() - progress.seconds) + " left";
    return line;
}

bool predicted_long(const parallel::Progress& progress) {
    return progress.seconds >= kPredictionBasis_s && progress.predicted_seconds() > kLongRender_s;
}

ProgressPrinter::ProgressPrinter(bool quiet) : quiet_(quiet) {}

parallel::ProgressCallback ProgressPrinter::callback() {
    return [this](const parallel::Progress& progress) { show(progress); };
}

void ProgressPrinter::clear() { line_.clear(); }

void ProgressPrinter::show(const parallel::Progress& progress) {
    if (quiet_) return;
    if (!warned_ && predicted_long(progress)) {
        clear();
        std::fprintf(stderr, "This render will take about %s.\n", duration_text(progress.predicted_seconds()).c_str());
        warned_ = true;
    }
    line_.show(progress_line(progress));
}

}  // namespace strata::tools::cli
