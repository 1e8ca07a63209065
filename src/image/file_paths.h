// Names of files: where they lead, which are the same, and what is derived from what was typed.
#pragma once

#include <filesystem>
#include <string_view>

namespace strata::image {

// The folder that a file is in, "." where its path names none.
std::filesystem::path folder_of(const std::filesystem::path& path);

// Where a file written to `path` comes to lie: the end of a chain of symbolic links, which need not exist yet. Throws
// ImageError for a chain without an end.
std::filesystem::path end_of_links(const std::filesystem::path& path);

// Whether writing to both paths writes one file: by other spellings, links of either kind, folders that are links.
// Neither needs to exist. "-" and other streams are no files.
bool is_one_file(const std::filesystem::path& a, const std::filesystem::path& b);

// `path` with `ending` in place of its extension, as "a.partial.exr" of "a.exr". A name that would be longer than its
// folder takes is cut and told from others by a hash, so that whatever name can be typed has all that are derived
// from it.
std::filesystem::path derived_path(const std::filesystem::path& path, std::string_view ending);

// The same without a folder: `beginning` and `ending` of a name that has `most` bytes at most.
std::string fitting_name(std::string_view beginning, std::string_view ending, std::size_t most = 255);

// TMPDIR, or /tmp.
std::filesystem::path temporary_place();

}  // namespace strata::image
