#include "tools/cli/stream_input.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <vector>

#include "src/image/read.h"
#include "src/scene/key_text.h"
#include "src/scene/scene_text.h"
#include "tools/cli/errors.h"

namespace strata::tools::cli {

namespace {

namespace fs = std::filesystem;

bool is_standard_input_read = false;

[[noreturn]] void fail(const std::string& typed, int error) {
    throw UsageError(
        fmt::format("{}: cannot be read: {}", scene::excerpt(typed), std::generic_category().message(error)));
}

bool is_stream(const std::string& typed) {
    if (typed == "-") return true;
    std::error_code error;
    const fs::file_status status = fs::status(typed, error);
    return fs::is_fifo(status) || fs::is_character_file(status);
}

int open_stream(const std::string& typed) {
    if (typed != "-" && typed != "/dev/stdin") return ::open(typed.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (is_standard_input_read) throw UsageError(typed + ": standard input is read already, allowed: once");
    is_standard_input_read = true;
    return ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
}

void copy(const std::string& typed, int from, int to, const fs::path& copied) {
    std::vector<char> buffer(1 << 16);
    std::size_t size = 0;
    for (;;) {
        const ssize_t count = ::read(from, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(typed, errno);
        if (count == 0 || (size > scene::kLargestFile && !image::is_picture(copied))) return;
        for (ssize_t done = 0; done < count;) {
            const ssize_t written = ::write(to, buffer.data() + done, static_cast<std::size_t>(count - done));
            if (written < 0 && errno != EINTR) fail(typed, errno);
            if (written > 0) done += written;
        }
        size += static_cast<std::size_t>(count);
    }
}

}  // namespace

std::optional<fs::path> spool_stream(const std::string& typed) {
    if (!is_stream(typed)) return std::nullopt;
    const int from = open_stream(typed);
    if (from < 0) fail(typed, errno);
    // It stays open: pictures are read more than once.
    const int to = ::memfd_create("strata-input", MFD_CLOEXEC);
    if (to < 0) fail(typed, errno);
    const fs::path copied = fmt::format("/proc/self/fd/{}", to);
    copy(typed, from, to, copied);
    ::close(from);
    return copied;
}

bool standard_input_is_read() { return is_standard_input_read; }

}  // namespace strata::tools::cli
