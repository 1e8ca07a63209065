// Files that appear whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "src/image/stream_target.h"

namespace strata::image {

// Whether a picture can be written to `path`, found out before it is rendered: the extension is known, the folder
// exists and takes a new file (one is made there and removed), `path` is free, a regular file that may be written, or a
// stream (stream_target.h) that is no terminal.
// Throws ImageError otherwise.
void check_writable(const std::filesystem::path& path);

// The same for a file of any kind, which replace_file() is to write.
void check_replaceable(const std::filesystem::path& path);

// A file in the making: a hidden one of its own in the folder of its target, which stays as it is until put_in_place().
// Removed by the destructor unless it is in place. All throw ImageError with the system's reason.
class OutputFile {
  public:
    // A symbolic link stays one; its target is what is replaced. What goes to a stream is held in memory until it is
    // put in place: written out.
    explicit OutputFile(const std::filesystem::path& target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write_at(std::int64_t offset, std::span<const unsigned char> bytes);
    void put_in_place();

    const std::filesystem::path& hidden_path() const { return hidden_; }

  private:
    void put_into_stream();

    std::filesystem::path target_;
    std::optional<StreamTarget> stream_;
    std::filesystem::path hidden_;
    int descriptor_ = -1;
    bool is_in_place_ = false;
};

// Writes `bytes` to a temporary file in the same folder and renames it to `path`. A symbolic link stays one; its target
// is replaced. On any error (ImageError, with the system's reason) the temporary file is gone and an earlier file is
// untouched. Not synchronised to the disk: it guards against a full disk or an interruption, not against power loss.
void replace_file(const std::filesystem::path& path, std::span<const unsigned char> bytes);

}  // namespace strata::image
