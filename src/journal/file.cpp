#include "src/journal/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "src/journal/descriptor.h"
#include "src/journal/journal_error.h"
#include "src/journal/scan.h"

namespace strata::journal {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
    throw JournalError(
        fmt::format("cannot {} the journal \"{}\": {}", what, path.string(), std::generic_category().message(error)));
}

FileId random_id() {
    FileId id = 0;
    if (::getrandom(&id, sizeof id, 0) != sizeof id) throw JournalError("the system gives no random bytes");
    return id;
}

// Whether the head never reached the disk, since the crash came before the first sync: it is zeros, or a part of a
// head.
bool is_blank(const ReadAt& read) {
    std::array<unsigned char, kFileHeadBytes> bytes{};
    const auto head = std::span(bytes).first(read(0, bytes));
    const auto expected = file_head(0);
    const std::size_t same = std::min(head.size(), expected.size() - sizeof(FileId));
    return std::ranges::all_of(head, [](unsigned char byte) { return byte == 0; }) ||
           (head.size() < bytes.size() && std::equal(head.begin(), head.begin() + same, expected.begin()));
}

}  // namespace

File File::create(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) fail(path, "make", errno);
    File file(path, descriptor);
    try {
        file.lock();
        file.begin();
    } catch (...) {
        ::unlink(path.c_str());
        throw;
    }
    return file;
}

void File::begin() {
    id_ = random_id();
    const auto head = file_head(id_);
    if (::ftruncate(descriptor_, 0) != 0) fail(path_, "write", errno);
    if (const int error = write_all(descriptor_, 0, head)) fail(path_, "write", error);
    end_ = kFileHeadBytes;
}

std::optional<File> File::open(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0 && errno == ENOENT) return std::nullopt;
    if (descriptor < 0) fail(path, "open", errno);
    File file(path, descriptor);
    file.lock();
    file.find_records();
    return file;
}

File::~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

File::File(File&& other) noexcept { *this = std::move(other); }

File& File::operator=(File&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(id_, other.id_);
    std::swap(end_, other.end_);
    std::swap(is_name_synced_, other.is_name_synced_);
    std::swap(places_, other.places_);
    return *this;
}

// A file system without locks has none to respect.
void File::lock() {
    while (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno == EWOULDBLOCK) {
            throw JournalInUse(fmt::format("another process is writing the journal \"{}\"", path_.string()));
        }
        if (errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP) return;
        fail(path_, "lock", errno);
    }
}

void File::find_records() {
    int error = 0;
    const ReadAt read = [&](std::int64_t offset, std::span<unsigned char> bytes) {
        return read_some(descriptor_, offset, bytes, error);
    };
    struct stat found {};
    if (::fstat(descriptor_, &found) != 0) fail(path_, "read", errno);
    std::optional<Scan> scanned = scan(read, found.st_size);
    if (error != 0) fail(path_, "read", error);
    if (!scanned && is_blank(read)) return begin();
    if (!scanned) throw JournalError(fmt::format("\"{}\" is no journal", path_.string()));
    id_ = scanned->id;
    end_ = scanned->end;
    places_ = std::move(scanned->places);
    if (end_ < found.st_size && ::ftruncate(descriptor_, end_) != 0) fail(path_, "cut", errno);
}

std::vector<unsigned char> File::read(const RecordPlace& place) const {
    std::vector<unsigned char> bytes(place.length);
    std::vector<unsigned char> head(kRecordHeadBytes);
    int error = 0;
    const auto head_offset = place.offset - static_cast<std::int64_t>(kRecordHeadBytes);
    const bool is_there = read_some(descriptor_, head_offset, head, error) == head.size() &&
                          read_some(descriptor_, place.offset, bytes, error) == bytes.size();
    if (error != 0) fail(path_, "read", error);
    const Bytes payload(bytes);
    const std::optional<RecordHead> expected = parse_record_head(head, id_);
    if (!is_there || !expected || expected->payload_check != checksum(id_, {&payload, 1})) {
        throw JournalError(fmt::format("the journal \"{}\" was changed while it was in use", path_.string()));
    }
    return bytes;
}

std::vector<unsigned char> File::read_start(const RecordPlace& place, std::size_t count) const {
    std::vector<unsigned char> bytes(std::min<std::uint64_t>(count, place.length));
    int error = 0;
    bytes.resize(read_some(descriptor_, place.offset, bytes, error));
    if (error != 0) fail(path_, "read", error);
    return bytes;
}

void File::append(std::uint32_t type, std::span<const Bytes> parts) {
    RecordHead head{type, 0, checksum(id_, parts)};
    for (const Bytes part : parts) head.length += part.size();
    const auto head_bytes = record_head(head, id_);
    std::int64_t at = end_;
    int error = write_all(descriptor_, at, head_bytes);
    at += static_cast<std::int64_t>(kRecordHeadBytes);
    for (std::size_t i = 0; i < parts.size() && error == 0; ++i) {
        error = write_all(descriptor_, at, parts[i]);
        at += static_cast<std::int64_t>(parts[i].size());
    }
    if (error != 0) {
        // If this fails too, the next reader does it.
        [[maybe_unused]] const int cut = ::ftruncate(descriptor_, end_);
        fail(path_, "write", error);
    }
    begin_writing_out(descriptor_, end_, at - end_);
    end_ = at;
}

void File::sync() {
    if (::fdatasync(descriptor_) != 0) fail(path_, "write", errno);
    if (!is_name_synced_) sync_folder();
    is_name_synced_ = true;
}

// Until then a crash may lose the file's name. Some file systems cannot do it for folders, and need not.
void File::sync_folder() const {
    const fs::path folder = path_.has_parent_path() ? path_.parent_path() : fs::path(".");
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

void File::rename_to(const fs::path& path) {
    if (::rename(path_.c_str(), path.c_str()) != 0) fail(path_, "rename", errno);
    path_ = path;
    is_name_synced_ = false;
}

void File::remove() {
    if (::unlink(path_.c_str()) != 0 && errno != ENOENT) fail(path_, "remove", errno);
}

}  // namespace strata::journal
