#include "tools/cli/status_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace strata::tools::cli {

namespace {

bool terminal_can_erase() {
    const char* const name = std::getenv("TERM");
    const std::string_view term = name != nullptr ? name : "";
    return !term.empty() && term != "dumb" && ::isatty(STDERR_FILENO) == 1;
}

std::size_t terminal_columns() {
    constexpr std::size_t kUsual = 80;
    winsize size{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
    return size.ws_col;
}

}  // namespace

StatusLine::StatusLine() : can_erase_(terminal_can_erase()) {}

void StatusLine::show(std::string_view text) {
    if (!can_erase_) return;
    // The last column stays free: some terminals wrap once it is filled.
    const std::string_view shown = cut_to_columns(text, terminal_columns() - 1);
    std::fprintf(stderr, "\r\033[K%.*s", static_cast<int>(shown.size()), shown.data());
    std::fflush(stderr);
    is_shown_ = true;
}

void StatusLine::clear() {
    if (is_shown_) std::fputs("\r\033[K", stderr);
    is_shown_ = false;
}

std::string_view cut_to_columns(std::string_view text, std::size_t columns) {
    std::size_t seen = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool begins = (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
        if (begins && seen++ == columns) return text.substr(0, i);
    }
    return text;
}

}  // namespace strata::tools::cli
