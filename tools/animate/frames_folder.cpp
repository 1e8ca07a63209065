#include "tools/animate/frames_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "src/image/file_paths.h"
#include "src/image/image_error.h"
#include "src/image/scratch_files.h"

namespace strata::tools::animate {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLock = ".lock";

// A lock on a file that has been removed meanwhile is none: whoever comes next makes another one.
bool is_there(int descriptor, const fs::path& path) {
    struct stat opened {
    }, named{};
    return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
           opened.st_dev == named.st_dev;
}

}  // namespace

FramesFolder::FramesFolder(const fs::path& film) {
    constexpr int kMost = 1000;
    for (int i = 1; i <= kMost; ++i) {
        const std::string ending = i == 1 ? ".frames" : fmt::format("-{}.frames", i);
        if (take(film.parent_path() / image::fitting_name(film.filename().string(), ending))) return;
    }
    throw image::ImageError(fmt::format("cannot write \"{}\": no folder for its frames can be made beside it: {}",
                                        film.string(), std::generic_category().message(errno)));
}

bool FramesFolder::take(const fs::path& folder) {
    if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) return false;
    const fs::path file = folder / kLock;
    const int opened = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (opened < 0) return false;
    // Where a file system has no locks, only its users can keep two runs apart.
    const bool is_taken = ::flock(opened, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (is_taken || !is_there(opened, file)) {
        ::close(opened);
        return false;
    }
    path_ = folder;
    lock_file_ = file;
    lock_ = opened;
    image::remember_scratch_file(path_.c_str());
    image::remember_scratch_file(lock_file_.c_str());
    return true;
}

FramesFolder::~FramesFolder() {
    ::unlink(lock_file_.c_str());
    ::close(lock_);
    ::rmdir(path_.c_str());
    image::forget_scratch_file(lock_file_.c_str());
    image::forget_scratch_file(path_.c_str());
}

}  // namespace strata::tools::animate
