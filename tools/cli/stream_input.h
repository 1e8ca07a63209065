// Inputs that can be read once only, from the front: standard input ("-"), pipes such as <(command), devices.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace strata::tools::cli {

// A file, in memory while the program runs, with what such an input holds: all of a picture, otherwise as much as a
// scene file may have and a byte. Nothing if `typed` names no such input. Throws UsageError for one that cannot be
// read, and for standard input the second time.
std::optional<std::filesystem::path> spool_stream(const std::string& typed);

// Whether standard input was taken by spool_stream().
bool standard_input_is_read();

}  // namespace strata::tools::cli
