// Outputs that are no files to be replaced but streams to be written into: standard output ("-"), named pipes, devices.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "src/image/format.h"

namespace strata::image {

struct StreamTarget {
    std::filesystem::path sink;    // "-", or what is opened
    std::optional<Format> format;  // of a "png:" before it, else of its extension
};

// Whether `path` is a stream: "-", a descriptor such as /dev/stdout or /dev/fd/3, an existing pipe or device. Before it
// may stand its format, as in "png:-".
std::optional<StreamTarget> stream_target(const std::filesystem::path& path);

bool is_standard_output(const std::filesystem::path& path);

// What keeps a stream from being written, as far as that shows without opening a pipe, which waits for its reader.
// Empty if nothing does. is_picture: a terminal is no place for it.
std::string stream_problem(const StreamTarget& target, bool is_picture);

// An unnamed file in memory: formats go back to earlier bytes, which a stream does not. -1 and errno on failure.
int open_memory_file();

// All bytes of that file into the stream. 0, or errno.
int copy_to_stream(int memory_file, const StreamTarget& target);

}  // namespace strata::image
