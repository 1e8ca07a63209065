// What a file takes over from another one. Private to src/image.
#pragma once

#include <sys/stat.h>

#include <filesystem>

namespace strata::image {

// The owner, group, mode and access list of the file `earlier` at `path`, as far as that is permitted. A group that
// cannot be kept gets what everybody has.
void take_over_rights(int file, const struct stat& earlier, const std::filesystem::path& path);

// All bytes of `from` into the beginning of `to`, which ends there. 0, or errno; ENOSPC, where the system knows it,
// before a byte is changed.
int copy_bytes(int from, int to);

// Some file systems report only when a file is closed that its bytes could not be stored. 0, or errno; the descriptor
// stays open.
int settle(int descriptor);

}  // namespace strata::image
