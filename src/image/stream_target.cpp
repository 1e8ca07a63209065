#include "src/image/stream_target.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace strata::image {
namespace fs = std::filesystem;
namespace {

// The descriptor that a path stands for, whatever is open there.
std::optional<int> descriptor_of(const fs::path& path) {
    const std::string text = path.string();
    if (text == "-" || text == "/dev/stdout") return STDOUT_FILENO;
    if (text == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        if (!text.starts_with(folder)) continue;
        int descriptor = -1;
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data() + folder.size(), end, descriptor);
        if (error == std::errc() && rest == end && descriptor >= 0) return descriptor;
    }
    return std::nullopt;
}

bool is_stream(const fs::path& path) {
    if (descriptor_of(path)) return true;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::is_fifo(status) || fs::is_character_file(status);
}

// A pipe is not opened: its reader would see the end when it is closed again.
bool is_terminal(const fs::path& sink) {
    if (const auto descriptor = descriptor_of(sink)) return ::isatty(*descriptor) == 1;
    std::error_code error;
    if (!fs::is_character_file(fs::status(sink, error))) return false;
    const int opened = ::open(sink.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    const bool is_one = opened >= 0 && ::isatty(opened) == 1;
    if (opened >= 0) ::close(opened);
    return is_one;
}

int open_sink(const fs::path& sink) {
    if (const auto descriptor = descriptor_of(sink)) return ::fcntl(*descriptor, F_DUPFD_CLOEXEC, 0);
    return ::open(sink.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
}

// 0, or errno. Somebody else may have made the stream non-blocking.
int write_all(int descriptor, const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t written = ::write(descriptor, bytes, count);
        if (written < 0 && errno == EAGAIN) {
            pollfd waiting{descriptor, POLLOUT, 0};
            ::poll(&waiting, 1, -1);
            continue;
        }
        if (written < 0 && errno != EINTR) return errno;
        if (written < 0) continue;
        bytes += written;
        count -= static_cast<std::size_t>(written);
    }
    return 0;
}

}  // namespace

std::optional<StreamTarget> stream_target(const fs::path& path) {
    const std::string text = path.string();
    const auto colon = text.find(':');
    if (colon != std::string::npos) {
        const fs::path sink = text.substr(colon + 1);
        const auto format = known_format(text.substr(0, colon).insert(0, 1, '.'));
        if (format && is_stream(sink)) return StreamTarget{sink, format};
    }
    if (!is_stream(path)) return std::nullopt;
    return StreamTarget{path, known_format(extension_of(path))};
}

bool is_standard_output(const fs::path& path) {
    const auto target = stream_target(path);
    return target && descriptor_of(target->sink) == STDOUT_FILENO;
}

std::string stream_problem(const StreamTarget& target, bool is_picture) {
    if (const auto descriptor = descriptor_of(target.sink)) {
        const int flags = ::fcntl(*descriptor, F_GETFL);
        if (flags < 0) return "it is not open";
        if ((flags & O_ACCMODE) == O_RDONLY) return "it is not open for writing";
    } else if (::access(target.sink.c_str(), W_OK) != 0) {
        return std::generic_category().message(errno);
    }
    return is_picture && is_terminal(target.sink)
               ? "a terminal does not show pictures; allowed: a pipe, or > FILE behind the command"
               : "";
}

int open_memory_file() { return ::memfd_create("strata-output", MFD_CLOEXEC); }

int copy_to_stream(int memory_file, const StreamTarget& target) {
    const int sink = open_sink(target.sink);
    if (sink < 0) return errno;
    std::vector<char> buffer(1 << 16);
    off_t offset = 0;
    int error = 0;
    while (error == 0) {
        const ssize_t count = ::pread(memory_file, buffer.data(), buffer.size(), offset);
        if (count < 0 && errno == EINTR) continue;
        if (count == 0) break;
        error = count < 0 ? errno : write_all(sink, buffer.data(), static_cast<std::size_t>(count));
        offset += count;
    }
    if (::close(sink) != 0 && error == 0) error = errno;
    return error;
}

}  // namespace strata::image
