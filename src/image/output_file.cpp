#include "src/image/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>

#include "src/image/format.h"
#include "src/image/image_error.h"
#include "src/image/scratch_files.h"

namespace strata::image {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
    throw ImageError(fmt::format("cannot write \"{}\": {}", path.string(), reason));
}

std::string system_reason(int error) { return std::generic_category().message(error); }

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// Where the bytes go: the end of a chain of symbolic links whose target exists, otherwise `path` itself.
fs::path resolve_links(const fs::path& path) {
    std::error_code error;
    if (!fs::is_symlink(path, error)) return path;
    const fs::path target = fs::canonical(path, error);
    return error ? path : target;
}

void check_target(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) return;
    if (error) fail(path, error.message());
    if (fs::is_directory(status)) fail(path, "it is a folder");
    if (!fs::is_regular_file(status)) fail(path, "it is not a regular file");
    if (::access(path.c_str(), W_OK) != 0) fail(path, system_reason(errno));
}

void check_stream(const fs::path& path, const StreamTarget& stream, bool is_picture) {
    const std::string problem = stream_problem(stream, is_picture);
    if (!problem.empty()) fail(path, problem);
}

void check_folder(const fs::path& path) {
    const fs::path folder = folder_of(path);
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (status.type() == fs::file_type::not_found)
        fail(path, fmt::format("the folder \"{}\" does not exist", folder.string()));
    if (error) fail(path, error.message());
    if (!fs::is_directory(status)) fail(path, fmt::format("\"{}\" is not a folder", folder.string()));
}

}  // namespace

OutputFile::OutputFile(const fs::path& target) : target_(resolve_links(target)), stream_(stream_target(target)) {
    if (stream_) {
        target_ = target;
        descriptor_ = open_memory_file();
        if (descriptor_ < 0) fail(target_, system_reason(errno));
        hidden_ = fmt::format("/proc/self/fd/{}", descriptor_);
        return;
    }
    static std::atomic<unsigned> counter{0};
    do {
        // Short, so that it fits wherever the target does; hidden, so that a glob for pictures does not meet it.
        hidden_ = folder_of(target_) / fmt::format(".strata-{}-{}", ::getpid(), counter++);
        descriptor_ = ::open(hidden_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && (errno == EEXIST || errno == EINTR));
    if (descriptor_ < 0) fail(target_, fmt::format("no new file in its folder: {}", system_reason(errno)));
    remember_scratch_file(hidden_.c_str());
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!is_in_place_ && !stream_) ::unlink(hidden_.c_str());
    forget_scratch_file(hidden_.c_str());
}

void OutputFile::write_at(std::int64_t offset, std::span<const unsigned char> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(target_, system_reason(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += written;
    }
}

void OutputFile::put_into_stream() {
    const int error = copy_to_stream(descriptor_, *stream_);
    if (error != 0) fail(target_, system_reason(error));
    is_in_place_ = true;
}

void OutputFile::put_in_place() {
    if (stream_) return put_into_stream();
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    // Some file systems report a full disk only here.
    if (closed != 0) fail(target_, system_reason(errno));
    if (::rename(hidden_.c_str(), target_.c_str()) != 0) fail(target_, system_reason(errno));
    is_in_place_ = true;
}

void check_writable(const fs::path& path) {
    format_of(path);
    if (const auto stream = stream_target(path)) return check_stream(path, *stream, true);
    check_replaceable(path);
}

void check_replaceable(const fs::path& path) {
    if (const auto stream = stream_target(path)) return check_stream(path, *stream, false);
    if (!path.has_filename()) fail(path, "it names no file");
    check_folder(path);
    check_target(path);
    const OutputFile probe(path);
}

void replace_file(const fs::path& path, std::span<const unsigned char> bytes) {
    OutputFile file(path);
    file.write_at(0, bytes);
    file.put_in_place();
}

}  // namespace strata::image
