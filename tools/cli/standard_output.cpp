#include "tools/cli/standard_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>

#include "src/image/stream_target.h"
#include "tools/cli/errors.h"

namespace strata::tools::cli {

namespace {

bool is_output_kept = false;
int output_error = 0;  // errno of the first write that failed

void note(bool written) {
    if (!written && output_error == 0) output_error = errno != 0 ? errno : EIO;
}

std::string visible(std::string_view text) {
    std::string shown;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
        shown += is_control ? fmt::format("\\u{:04X}", byte) : std::string(1, c);
    }
    return shown;
}

// Opened the wrong way round: using it stays an error.
void occupy(int descriptor, int wrong_direction) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) return;
    [[maybe_unused]] const int lowest_free = ::open("/dev/null", wrong_direction);
}

}  // namespace

void guard_standard_streams() {
    occupy(STDIN_FILENO, O_WRONLY);
    occupy(STDOUT_FILENO, O_RDONLY);
    occupy(STDERR_FILENO, O_RDONLY);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void keep_output_for(const std::filesystem::path& path) { is_output_kept |= image::is_standard_output(path); }

void print_out(std::string_view text) {
    const bool to_terminal = is_output_kept || ::isatty(STDOUT_FILENO) == 1;
    const std::string shown = to_terminal ? visible(text) : std::string(text);
    if (is_output_kept) {
        std::fwrite(shown.data(), 1, shown.size(), stderr);
        return;
    }
    errno = 0;
    note(std::fwrite(shown.data(), 1, shown.size(), stdout) == shown.size());
}

bool flush_out() {
    errno = 0;
    note(std::fflush(stdout) == 0);
    return output_error == 0;
}

void print_error(std::string_view message) { std::fprintf(stderr, "strata: %s\n", visible(message).c_str()); }

int finish_output(int exit_code) {
    if (flush_out() || output_error == EPIPE) return exit_code;
    print_error("cannot write to standard output: " + std::generic_category().message(output_error));
    return exit_code != 0 ? exit_code : kExitRuntime;
}

}  // namespace strata::tools::cli
