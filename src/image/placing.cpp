#include "src/image/placing.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "src/image/file_copy.h"
#include "src/image/file_paths.h"
#include "src/image/image_error.h"
#include "src/image/scratch_files.h"

namespace strata::image {
namespace fs = std::filesystem;
namespace {

// Short, so that it fits wherever the target does; hidden, so that a glob for pictures does not meet it. 60 random
// bits: numbers of processes are the same in other containers and on other machines.
std::string random_name() {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz012345";
    std::array<unsigned char, 12> random{};
    if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size()))
        throw std::runtime_error("the system gives no random bytes");
    std::string name = ".strata-";
    for (const unsigned char byte : random) name += kLetters[byte % kLetters.size()];
    return name;
}

// What is there may be replaced by whoever may write it.
bool is_writable_file(const fs::path& path) {
    struct stat found {};
    return ::stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode) && ::access(path.c_str(), W_OK) == 0;
}

// Made exclusively: NAME.kept.EXT, or NAME.kept-2.EXT where that is taken. The descriptor and its name, or -1.
std::pair<int, std::string> open_visible(int folder, const fs::path& target) {
    constexpr int kMost = 1000;
    for (int i = 1; i <= kMost; ++i) {
        const std::string count = i == 1 ? "" : fmt::format("-{}", i);
        const fs::path path = derived_path(target, fmt::format(".kept{}{}", count, target.extension().string()));
        std::string name = path.filename().string();
        const int opened = ::openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (opened >= 0) return {opened, std::move(name)};
        if (errno != EEXIST && errno != EINTR) break;
    }
    return {-1, ""};
}

}  // namespace

ScratchFile::ScratchFile(const fs::path& target) : ScratchFile(target, false) {}

ScratchFile::ScratchFile(const fs::path& target, bool is_second)
    : typed_(target), target_(end_of_links(target)), is_second_(is_second) {
    int error = open_in(folder_of(target_));
    if (error != 0 && !is_second_ && is_writable_file(target_)) {
        is_beside_ = false;
        if (open_in(temporary_place()) == 0) error = 0;
    }
    if (error != 0) fail_to_write(target, fmt::format("no new file in its folder: {}", system_reason(error)));
    remember_scratch_file(hidden_.c_str());
}

int ScratchFile::open_in(const fs::path& folder) {
    close_all();
    folder_ = ::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (folder_ < 0) return errno;
    // Whoever may not read what is there shall not read what replaces it, not even while it is made.
    struct stat earlier {};
    const bool replaces = ::stat(target_.c_str(), &earlier) == 0;
    const mode_t mode = replaces ? 0600 | (earlier.st_mode & 0606) : 0666;
    do {
        name_ = random_name();
        descriptor_ = ::openat(folder_, name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    } while (descriptor_ < 0 && (errno == EEXIST || errno == EINTR));
    if (descriptor_ < 0) return errno;
    hidden_ = folder / name_;
    return 0;
}

void ScratchFile::close_all() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (folder_ >= 0) ::close(folder_);
    descriptor_ = folder_ = -1;
}

void ScratchFile::drop() {
    ::unlinkat(folder_, name_.c_str(), 0);
    is_done_ = true;
}

ScratchFile::~ScratchFile() {
    if (!is_done_) drop();
    close_all();
    forget_scratch_file(hidden_.c_str());
}

void ScratchFile::place() {
    if (const int error = settle(descriptor_)) fail_to_write(typed_, system_reason(error));
    const int error = move_into_place();
    if (error == 0) return check_folder_stayed();
    // A link that was made meanwhile leads elsewhere; a folder or hidden file that is gone can be made again.
    if ((error == ENOENT || error == ELOOP) && copy_beside()) return drop();
    const int copying = copy_into_place();
    if (copying == 0) return drop();
    keep(system_reason(copying == ENOSPC || copying == EDQUOT ? copying : error));
}

int ScratchFile::move_into_place() {
    if (!is_beside_) return EXDEV;
    const std::string name = target_.filename().string();
    struct stat earlier {};
    if (::fstatat(folder_, name.c_str(), &earlier, AT_SYMLINK_NOFOLLOW) == 0) {
        if (S_ISLNK(earlier.st_mode)) return ELOOP;
        if (S_ISREG(earlier.st_mode)) take_over_rights(descriptor_, earlier, target_);
    }
    if (::renameat(folder_, name_.c_str(), folder_, name.c_str()) != 0) return errno;
    is_done_ = true;
    return 0;
}

void ScratchFile::check_folder_stayed() {
    if (has_folder()) return;
    fail_to_write(typed_, fmt::format("its folder was moved meanwhile; the whole file is \"{}\"",
                                      (folder_now() / target_.filename()).string()));
}

// The file that is there keeps all that its owner set.
int ScratchFile::copy_into_place() {
    const int there = ::open(target_.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (there < 0) return errno;
    struct stat found {};
    int error = ::fstat(there, &found) != 0 ? errno : S_ISREG(found.st_mode) ? 0 : EEXIST;
    if (error == 0) error = copy_bytes(descriptor_, there);
    if (::close(there) != 0 && error == 0) error = errno;
    return error;
}

bool ScratchFile::copy_beside() {
    if (is_second_) return false;
    try {
        ScratchFile again(typed_, true);
        if (copy_bytes(descriptor_, again.descriptor_) != 0) return false;
        return again.move_into_place() == 0;
    } catch (const ImageError&) {
        return false;
    }
}

void ScratchFile::keep(const std::string& reason) {
    fs::path kept = keep_in_folder();
    if (kept.empty()) kept = keep_elsewhere();
    if (kept.empty() && ::faccessat(folder_, name_.c_str(), F_OK, 0) == 0) kept = folder_now() / name_;
    if (kept.empty()) fail_to_write(typed_, reason);
    is_done_ = true;
    fail_to_write(typed_, fmt::format("{}; the whole file is \"{}\"", reason, kept.string()));
}

fs::path ScratchFile::keep_in_folder() {
    const auto [visible, name] = open_visible(folder_, target_);
    if (visible < 0) return {};
    ::close(visible);
    if (::renameat(folder_, name_.c_str(), folder_, name.c_str()) == 0) return folder_now() / name;
    ::unlinkat(folder_, name.c_str(), 0);
    return {};
}

fs::path ScratchFile::keep_elsewhere() {
    const fs::path place = temporary_place();
    const int folder = ::open(place.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return {};
    const auto [visible, name] = open_visible(folder, target_.filename());
    const bool is_whole = visible >= 0 && copy_bytes(descriptor_, visible) == 0;
    if (visible >= 0 && !is_whole) ::unlinkat(folder, name.c_str(), 0);
    if (visible >= 0) ::close(visible);
    ::close(folder);
    if (!is_whole) return {};
    ::unlinkat(folder_, name_.c_str(), 0);
    return place / name;
}

bool ScratchFile::has_folder() const {
    struct stat then {
    }, now{};
    return ::fstat(folder_, &then) == 0 && ::stat(folder_of(hidden_).c_str(), &now) == 0 && then.st_dev == now.st_dev &&
           then.st_ino == now.st_ino;
}

fs::path ScratchFile::folder_now() const {
    if (has_folder()) return folder_of(hidden_);
    std::error_code error;
    const fs::path moved = fs::read_symlink(fmt::format("/proc/self/fd/{}", folder_), error);
    return error ? folder_of(hidden_) : moved;
}

}  // namespace strata::image
