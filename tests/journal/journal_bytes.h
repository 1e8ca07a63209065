// A journal in memory, as a crash may leave it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "src/journal/record.h"
#include "src/journal/scan.h"

namespace strata::journal {

using Block = std::vector<unsigned char>;

inline constexpr FileId kTestId = 0x1234'5678'9abc'def0;

inline Block journal_of(const std::vector<Block>& payloads, FileId id = kTestId) {
    const auto file = file_head(id);
    Block bytes(file.begin(), file.end());
    for (const Block& payload : payloads) {
        const Bytes part(payload);
        const auto head = record_head({7, payload.size(), checksum(id, {&part, 1})}, id);
        bytes.insert(bytes.end(), head.begin(), head.end());
        bytes.insert(bytes.end(), payload.begin(), payload.end());
    }
    return bytes;
}

inline std::optional<Scan> scan_of(const Block& bytes) {
    const ReadAt read = [&](std::int64_t offset, std::span<unsigned char> into) {
        const auto at = static_cast<std::size_t>(offset);
        const std::size_t count = at >= bytes.size() ? 0 : std::min(into.size(), bytes.size() - at);
        std::copy_n(bytes.begin() + offset, count, into.begin());
        return count;
    };
    return scan(read, static_cast<std::int64_t>(bytes.size()));
}

inline Block random_block(std::mt19937_64& random, std::size_t size) {
    Block block(size);
    for (unsigned char& byte : block) byte = static_cast<unsigned char>(random());
    return block;
}

// What a scan found, taken out of the bytes.
inline std::vector<Block> payloads_in(const Block& bytes, const Scan& scan) {
    std::vector<Block> payloads;
    for (const RecordPlace& place : scan.places) {
        const auto begin = bytes.begin() + place.offset;
        payloads.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(place.length));
    }
    return payloads;
}

}  // namespace strata::journal
