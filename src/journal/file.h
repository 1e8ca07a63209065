// A journal on the disk: records are appended, checked when it is opened again, and removed with their file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "src/journal/record.h"

namespace strata::journal {

// Where a whole record lies.
struct RecordPlace {
    std::uint32_t type = 0;
    std::int64_t offset = 0;  // of its payload
    std::uint64_t length = 0;
};

// One process has a journal open at a time: it holds the system's lock on the file (flock). Not for several threads at
// once, but for read(). All throw JournalError with the system's reason.
class File {
  public:
    // A new one, readable by its owner alone. Throws where there is a file of that name.
    static File create(const std::filesystem::path& path);

    // One that is there: whole records are listed in places(), damaged ones are passed over, and what lies behind the
    // last that can be found is cut off. One that a crash left without a head is begun anew. Nothing where there is no
    // file. Throws JournalInUse, and JournalError for a
    // file that is no journal.
    static std::optional<File> open(const std::filesystem::path& path);

    ~File();
    File(File&& other) noexcept;
    File& operator=(File&& other) noexcept;

    // Of the records that were whole when the file was opened, in the order of the file.
    std::span<const RecordPlace> places() const { return places_; }

    // A payload. Throws too if it is not what was written.
    std::vector<unsigned char> read(const RecordPlace& place) const;

    // The first bytes of a payload, unchecked: it was whole when the file was opened.
    std::vector<unsigned char> read_start(const RecordPlace& place, std::size_t count) const;

    // The parts one behind the other are the payload. On failure what is there stays as it was. Asks the system to
    // begin writing to the disk, and does not wait for it.
    void append(std::uint32_t type, std::span<const Bytes> parts);

    // Returns when all that was appended, and the file's name, are on the disk.
    void sync();

    // Takes the name of another journal, or of none, and what is found under that name is this one from then on. The
    // other one's owner may keep it open.
    void rename_to(const std::filesystem::path& path);

    void remove();

    std::int64_t bytes() const { return end_; }
    const std::filesystem::path& path() const { return path_; }

  private:
    File(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
    void lock();
    void begin();
    void find_records();
    void sync_folder() const;

    std::filesystem::path path_;
    int descriptor_ = -1;
    FileId id_ = 0;
    std::int64_t end_ = 0;  // of the last record
    bool is_name_synced_ = false;
    std::vector<RecordPlace> places_;
};

}  // namespace strata::journal
