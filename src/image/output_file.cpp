#include "src/image/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "src/image/file_paths.h"
#include "src/image/format.h"
#include "src/image/image_error.h"

namespace strata::image {
namespace fs = std::filesystem;
namespace {

void check_target(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) return;
    if (error) fail_to_write(path, error.message());
    if (fs::is_directory(status)) fail_to_write(path, "it is a folder");
    if (!fs::is_regular_file(status)) fail_to_write(path, "it is not a regular file");
    if (::access(path.c_str(), W_OK) != 0) fail_to_write(path, system_reason(errno));
}

void check_stream(const fs::path& path, const StreamTarget& stream, bool is_picture) {
    const std::string problem = stream_problem(stream, is_picture);
    if (!problem.empty()) fail_to_write(path, problem);
}

void check_folder(const fs::path& path) {
    const fs::path folder = folder_of(end_of_links(path));
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (status.type() == fs::file_type::not_found)
        fail_to_write(path, fmt::format("the folder \"{}\" does not exist", folder.string()));
    if (error) fail_to_write(path, error.message());
    if (!fs::is_directory(status)) fail_to_write(path, fmt::format("\"{}\" is not a folder", folder.string()));
}

}  // namespace

OutputFile::OutputFile(const fs::path& target) : target_(target), stream_(stream_target(target)) {
    if (!stream_) {
        scratch_.emplace(target);
        return;
    }
    memory_ = open_memory_file();
    if (memory_ < 0) fail_to_write(target_, system_reason(errno));
}

OutputFile::~OutputFile() {
    if (memory_ >= 0) ::close(memory_);
}

fs::path OutputFile::hidden_path() const {
    fs::path path = fmt::format("/proc/self/fd/{}", descriptor());
    std::error_code error;
    return scratch_ && !fs::exists(path, error) ? scratch_->path() : path;
}

void OutputFile::write_at(std::int64_t offset, std::span<const unsigned char> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor(), bytes.data(), bytes.size(), offset);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail_to_write(target_, system_reason(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += written;
    }
}

std::size_t OutputFile::read_at(std::int64_t offset, std::span<unsigned char> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::pread(descriptor(), bytes.data() + done, bytes.size() - done, offset);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_to_write(target_, fmt::format("what was written cannot be read: {}", system_reason(errno)));
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
        offset += count;
    }
    return done;
}

void OutputFile::put_into_stream() {
    const int error = copy_to_stream(memory_, *stream_);
    if (error != 0) fail_to_write(target_, system_reason(error));
}

void OutputFile::put_in_place() {
    if (stream_) return put_into_stream();
    scratch_->place();
}

void OutputFile::keep(const std::string& reason) {
    if (!scratch_) fail_to_write(target_, reason);
    scratch_->keep(reason);
}

void check_writable(const fs::path& path) {
    format_of(path);
    if (const auto stream = stream_target(path)) return check_stream(path, *stream, true);
    check_replaceable(path);
}

void check_replaceable(const fs::path& path) {
    if (const auto stream = stream_target(path)) return check_stream(path, *stream, false);
    if (!path.has_filename()) fail_to_write(path, "it names no file");
    check_folder(path);
    check_target(path);
    const OutputFile probe(path);
}

void replace_file(const fs::path& path, std::span<const unsigned char> bytes) {
    OutputFile file(path);
    file.write_at(0, bytes);
    file.put_in_place();
}

void replace_file(const fs::path& path, std::string_view text) {
    replace_file(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

}  // namespace strata::image
