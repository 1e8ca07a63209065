#include "src/image/library_noise.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include "src/image/stream_target.h"

namespace strata::image {
namespace {

// Errors that were gathered are lines; what another line says too is left out.
std::string in_one_line(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        line = line.substr(0, line.find_last_not_of(" \r") + 1);
        const auto says = [](std::string_view a, std::string_view b) { return a.find(b) != std::string_view::npos; };
        if (std::ranges::any_of(lines, [&](std::string_view other) { return says(other, line); })) continue;
        std::erase_if(lines, [&](std::string_view other) { return says(line, other); });
        lines.push_back(line);
    }
    return fmt::format("{}", fmt::join(lines, "; "));
}

}  // namespace

// Without an unnamed file or another descriptor the noise is shown, which is no harm.
LibraryNoise::LibraryNoise() {
    std::fflush(stderr);
    kept_ = open_memory_file();
    if (kept_ < 0) return;
    shown_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    if (shown_ >= 0) ::dup2(kept_, STDERR_FILENO);
}

LibraryNoise::~LibraryNoise() {
    if (shown_ >= 0) {
        std::fflush(stderr);
        ::dup2(shown_, STDERR_FILENO);
        ::close(shown_);
    }
    if (kept_ >= 0) ::close(kept_);
}

std::string LibraryNoise::text() const {
    std::array<char, 400> buffer;
    const ssize_t size = kept_ < 0 ? 0 : ::pread(kept_, buffer.data(), buffer.size(), 0);
    if (size <= 0) return "";
    std::string_view line(buffer.data(), static_cast<std::size_t>(size));
    line = line.substr(0, line.find('\n'));
    for (const std::string_view prefix : {"libpng error: ", "libpng warning: "})
        if (line.starts_with(prefix)) line.remove_prefix(prefix.size());
    return in_one_line(line);
}

std::string LibraryNoise::explain(const std::string& error) const {
    std::string line = in_one_line(error);  // not const, so that it is moved out
    const std::string noise = text();
    if (noise.empty() || line.find(noise) != std::string::npos) return line;
    return line.empty() ? noise : fmt::format("{} ({})", line, noise);
}

}  // namespace strata::image
