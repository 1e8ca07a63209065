#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace strata::tools::cli {

// All of a file, pipes included; nothing, and why, if it cannot be read: it is missing, a folder, not permitted.
std::optional<std::string> read_text_file(const std::filesystem::path& path, std::string& why);

}  // namespace strata::tools::cli
