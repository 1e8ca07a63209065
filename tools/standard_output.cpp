#include "tools/standard_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "src/image/stream_target.h"
#include "tools/errors.h"

namespace strata::tools {

namespace {

bool is_output_kept = false;
int output_error = 0;  // errno of the first write that failed

void note(bool written) {
    if (!written && output_error == 0) output_error = errno != 0 ? errno : EIO;
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
    if (is_output_kept) {
        std::fwrite(text.data(), 1, text.size(), stderr);
        return;
    }
    errno = 0;
    note(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

bool flush_out() {
    errno = 0;
    note(std::fflush(stdout) == 0);
    return output_error == 0;
}

void print_error(std::string_view message) {
    std::fprintf(stderr, "strata: %.*s\n", static_cast<int>(message.size()), message.data());
}

int finish_output(int exit_code) {
    if (flush_out() || output_error == EPIPE) return exit_code;
    print_error("cannot write to standard output: " + std::generic_category().message(output_error));
    return exit_code != 0 ? exit_code : kExitRuntime;
}

}  // namespace strata::tools
