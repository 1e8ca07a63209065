#include "src/journal/scan.h"

#include <zlib.h>

#include <algorithm>
#include <array>

namespace strata::journal {
namespace {

// As checksum(), of a payload that may be larger than what should be held of it.
bool has_checksum(const ReadAt& read, const RecordPlace& place, FileId id, std::uint32_t expected) {
    constexpr std::uint64_t kBlock = 1 << 20;
    std::vector<unsigned char> block(std::min(place.length, kBlock));
    uLong sum = checksum(id, {});
    for (std::uint64_t done = 0; done < place.length;) {
        const std::span<unsigned char> part = std::span(block).first(std::min(kBlock, place.length - done));
        if (read(place.offset + static_cast<std::int64_t>(done), part) != part.size()) return false;
        sum = crc32_z(sum, part.data(), part.size());
        done += part.size();
    }
    return sum == expected;
}

}  // namespace

std::optional<Scan> scan(const ReadAt& read, std::int64_t size) {
    std::array<unsigned char, kFileHeadBytes> file_bytes{};
    const std::optional<FileId> id = read(0, file_bytes) == kFileHeadBytes ? id_of_file_head(file_bytes) : std::nullopt;
    if (!id) return std::nullopt;
    Scan result{*id, {}, kFileHeadBytes};
    constexpr auto kHead = static_cast<std::int64_t>(kRecordHeadBytes);
    while (size - result.end >= kHead) {
        std::array<unsigned char, kRecordHeadBytes> bytes{};
        if (read(result.end, bytes) != kRecordHeadBytes) break;
        const std::optional<RecordHead> head = parse_record_head(bytes, *id);
        if (!head || head->length > static_cast<std::uint64_t>(size - result.end - kHead)) break;
        const RecordPlace place{head->type, result.end + kHead, head->length};
        if (has_checksum(read, place, *id, head->payload_check)) result.places.push_back(place);
        result.end = place.offset + static_cast<std::int64_t>(place.length);
    }
    return result;
}

}  // namespace strata::journal
