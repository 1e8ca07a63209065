#include "src/image/file_copy.h"

#include <fcntl.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <vector>

namespace strata::image {
namespace {

constexpr const char* kAccessList = "system.posix_acl_access";

// One that a new file has from its folder goes where the earlier one had none.
void take_over_access_list(int file, const std::filesystem::path& path) {
    std::array<char, 65536> list{};
    const ssize_t size = ::lgetxattr(path.c_str(), kAccessList, list.data(), list.size());
    if (size > 0) {
        ::fsetxattr(file, kAccessList, list.data(), static_cast<std::size_t>(size), 0);
    } else if (errno == ENODATA) {
        ::fremovexattr(file, kAccessList);
    }
}

int write_all(int to, const char* bytes, ssize_t count, off_t offset) {
    while (count > 0) {
        const ssize_t written = ::pwrite(to, bytes, static_cast<std::size_t>(count), offset);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes += written;
        count -= written;
        offset += written;
    }
    return 0;
}

}  // namespace

void take_over_rights(int file, const struct stat& earlier, const std::filesystem::path& path) {
    constexpr mode_t kAll = 0777, kWithoutGroup = 0707, kOthers = 0007;
    struct stat own {};
    if (::fstat(file, &own) != 0) return;
    mode_t mode = earlier.st_mode & kAll;
    const bool has_group = own.st_gid == earlier.st_gid || ::fchown(file, static_cast<uid_t>(-1), earlier.st_gid) == 0;
    if (!has_group) mode = (mode & kWithoutGroup) | ((mode & kOthers) << 3);
    if (has_group) take_over_access_list(file, path);
    ::fchmod(file, mode);
    // Last: whoever gives a file away may not change it any more.
    if (own.st_uid == earlier.st_uid) return;
    [[maybe_unused]] const int not_permitted = ::fchown(file, earlier.st_uid, static_cast<gid_t>(-1));
}

int copy_bytes(int from, int to) {
    struct stat whole {};
    if (::fstat(from, &whole) != 0) return errno;
    if (whole.st_size > 0 && ::fallocate(to, FALLOC_FL_KEEP_SIZE, 0, whole.st_size) != 0 &&
        (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)) {
        return errno;
    }
    std::vector<char> buffer(1 << 18);
    off_t offset = 0;
    while (offset < whole.st_size) {
        const ssize_t count = ::pread(from, buffer.data(), buffer.size(), offset);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return count < 0 ? errno : EIO;
        if (const int error = write_all(to, buffer.data(), count, offset)) return error;
        offset += count;
    }
    if (::ftruncate(to, whole.st_size) != 0) return errno;
    return settle(to);
}

int settle(int descriptor) {
    const int copy = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) return 0;  // no descriptor is free, which says nothing of the bytes
    return ::close(copy) == 0 ? 0 : errno;
}

}  // namespace strata::image
