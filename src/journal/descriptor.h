// Whole reads and writes of an open file, through interruptions. Private to src/journal.
#pragma once

#include <cstdint>
#include <span>

namespace strata::journal {

// 0, or errno.
int write_all(int descriptor, std::int64_t offset, std::span<const unsigned char> bytes);

// How many of the bytes there are; sets `error` to errno where reading fails.
std::size_t read_some(int descriptor, std::int64_t offset, std::span<unsigned char> bytes, int& error);

// The system writes this part to the disk from now on, so that a later sync has less to wait for. Nothing depends on
// it.
void begin_writing_out(int descriptor, std::int64_t offset, std::int64_t count);

}  // namespace strata::journal
