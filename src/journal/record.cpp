#include "src/journal/record.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

namespace strata::journal {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

constexpr std::string_view kMagic = "STRATAJ1";
constexpr std::uint32_t kMark = 0x44524352;  // "RCRD"

template <class Number>
void put(unsigned char* at, Number number) {
    std::memcpy(at, &number, sizeof number);
}

template <class Number>
Number get(const unsigned char* at) {
    Number number;
    std::memcpy(&number, at, sizeof number);
    return number;
}

}  // namespace

std::array<unsigned char, kFileHeadBytes> file_head(FileId id) {
    std::array<unsigned char, kFileHeadBytes> head{};
    std::ranges::copy(kMagic, head.begin());
    put(head.data() + kMagic.size(), id);
    return head;
}

std::optional<FileId> id_of_file_head(Bytes head) {
    if (head.size() < kFileHeadBytes || !std::equal(kMagic.begin(), kMagic.end(), head.begin())) return std::nullopt;
    return get<FileId>(head.data() + kMagic.size());
}

std::uint32_t checksum(FileId id, std::span<const Bytes> parts) {
    uLong sum = crc32_z(0, reinterpret_cast<const unsigned char*>(&id), sizeof id);
    for (const Bytes part : parts) {
        if (!part.empty()) sum = crc32_z(sum, part.data(), part.size());  // begins anew where there are no bytes
    }
    return static_cast<std::uint32_t>(sum);
}

std::array<unsigned char, kRecordHeadBytes> record_head(const RecordHead& head, FileId id) {
    std::array<unsigned char, kRecordHeadBytes> bytes{};
    put(bytes.data(), kMark);
    put(bytes.data() + 4, head.type);
    put(bytes.data() + 8, head.length);
    put(bytes.data() + 16, head.payload_check);
    const Bytes checked = Bytes(bytes).first(20);
    put(bytes.data() + 20, checksum(id, {&checked, 1}));
    return bytes;
}

std::optional<RecordHead> parse_record_head(Bytes bytes, FileId id) {
    if (bytes.size() < kRecordHeadBytes || get<std::uint32_t>(bytes.data()) != kMark) return std::nullopt;
    const Bytes checked = bytes.first(20);
    if (get<std::uint32_t>(bytes.data() + 20) != checksum(id, {&checked, 1})) return std::nullopt;
    return RecordHead{get<std::uint32_t>(bytes.data() + 4), get<std::uint64_t>(bytes.data() + 8),
                      get<std::uint32_t>(bytes.data() + 16)};
}

}  // namespace strata::journal
