// What of a journal's bytes can be relied on.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "src/journal/file.h"

namespace strata::journal {

// Fills `bytes` from an offset as far as there are any, and tells how many there were.
using ReadAt = std::function<std::size_t(std::int64_t offset, std::span<unsigned char> bytes)>;

struct Scan {
    FileId id = 0;
    std::vector<RecordPlace> places;  // of whole records, in the order of the file
    std::int64_t end = 0;             // behind the last record whose head is whole and whose payload is not cut
};

// Nothing for what does not begin as a journal. A record with a whole head and a wrong payload is passed over; at the
// first head that is wrong, or that tells of more bytes than there are, the journal ends.
std::optional<Scan> scan(const ReadAt& read, std::int64_t size);

}  // namespace strata::journal
