// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <span>

namespace strata::image {

// Whether a picture can be written to `path`, found out before it is rendered: the extension is known, the folder
// exists and takes a new file (one is made there and removed), `path` is free or a regular file that may be written.
// Throws ImageError otherwise.
void check_writable(const std::filesystem::path& path);

// The same for a file of any kind, which replace_file() is to write.
void check_replaceable(const std::filesystem::path& path);

// Writes `bytes` to a temporary file in the same folder and renames it to `path`. A symbolic link stays one; its target
// is replaced. On any error (ImageError, with the system's reason) the temporary file is gone and an earlier file is
// untouched. Not synchronised to the disk: it guards against a full disk or an interruption, not against power loss.
void replace_file(const std::filesystem::path& path, std::span<const unsigned char> bytes);

}  // namespace strata::image
