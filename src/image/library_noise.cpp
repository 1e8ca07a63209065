#include "src/image/library_noise.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string_view>

#include "src/image/stream_target.h"

namespace strata::image {
namespace {

// Errors that were gathered are lines.
std::string in_one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) text.replace(at, 1, "; ");
    return text;
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
    return in_one_line(std::string(line));
}

std::string LibraryNoise::explain(std::string error) const {
    error = in_one_line(std::move(error));
    const std::string noise = text();
    if (noise.empty() || error.find(noise) != std::string::npos) return error;
    return error.empty() ? noise : fmt::format("{} ({})", error, noise);
}

}  // namespace strata::image
