#include "src/journal/descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace strata::journal {

int write_all(int descriptor, std::int64_t offset, std::span<const unsigned char> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), offset);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += written;
    }
    return 0;
}

std::size_t read_some(int descriptor, std::int64_t offset, std::span<unsigned char> bytes, int& error) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count =
            ::pread(descriptor, bytes.data() + done, bytes.size() - done, offset + static_cast<std::int64_t>(done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) error = errno;
        if (count <= 0) break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

void begin_writing_out(int descriptor, std::int64_t offset, std::int64_t count) {
    const int interrupted_errno = errno;
    ::sync_file_range(descriptor, offset, count, SYNC_FILE_RANGE_WRITE);
    errno = interrupted_errno;
}

}  // namespace strata::journal
