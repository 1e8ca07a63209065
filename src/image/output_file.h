// Files that appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "src/image/placing.h"
#include "src/image/stream_target.h"

namespace strata::image {

// Whether a picture can be written to `path`, found out before it is rendered: the extension is known, the folder
// exists and takes a new file (one is made there and removed), `path` is free, a regular file that may be written, or a
// stream (stream_target.h) that is no terminal.
// Throws ImageError otherwise.
void check_writable(const std::filesystem::path& path);

// The same for a file of any kind, which replace_file() is to write.
void check_replaceable(const std::filesystem::path& path);

// A file in the making: a hidden one of its own (placing.h) beside its target, which stays as it is until
// put_in_place(). Removed by the destructor unless it is in place. All throw ImageError with the system's reason.
class OutputFile {
  public:
    // What goes to a stream is held in memory until it is put in place: written out.
    explicit OutputFile(const std::filesystem::path& target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write_at(std::int64_t offset, std::span<const unsigned char> bytes);

    // As many bytes as there are, up to all of `bytes`.
    std::size_t read_at(std::int64_t offset, std::span<unsigned char> bytes) const;

    // As ScratchFile::place().
    void put_in_place();

    // As ScratchFile::keep(); nothing of a stream is kept.
    [[noreturn]] void keep(const std::string& reason);

    // What was asked for.
    const std::filesystem::path& target() const { return target_; }

    // Its hidden file; nothing of a stream.
    std::optional<std::filesystem::path> scratch_path() const {
        return scratch_ ? std::optional(scratch_->path()) : std::nullopt;
    }

    // What is written meanwhile, by a name that stays right when its folder is moved.
    std::filesystem::path hidden_path() const;

  private:
    void put_into_stream();
    int descriptor() const { return scratch_ ? scratch_->descriptor() : memory_; }

    std::filesystem::path target_;
    std::optional<StreamTarget> stream_;
    std::optional<ScratchFile> scratch_;  // of a file
    int memory_ = -1;                     // of a stream
};

// Writes `bytes` to a hidden file and puts it in place (placing.h): all of them or, with ImageError and the system's
// reason, none. Not synchronised to the disk: it guards against a full disk or an interruption, not against power loss.
void replace_file(const std::filesystem::path& path, std::span<const unsigned char> bytes);

// The same of a text.
void replace_file(const std::filesystem::path& path, std::string_view text);

}  // namespace strata::image
