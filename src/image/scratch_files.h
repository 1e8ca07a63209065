// The hidden files that are being written, so that a signal which ends the program at once can remove them.
#pragma once

namespace strata::image {

// From open() on; a folder before the files in it. The path must stay where it is until forget_scratch_file(). Of more
// than a few hundred at a time the rest are not remembered. Never returns once remove_scratch_files() was called: the
// program is about to end.
void remember_scratch_file(const char* path) noexcept;

// Before the path's memory goes; also of one that was not remembered.
void forget_scratch_file(const char* path) noexcept;

// Removes all that are remembered. Touches lock-free atomics and calls unlink() and rmdir() only: for signal handlers,
// before the program ends.
void remove_scratch_files() noexcept;

}  // namespace strata::image
