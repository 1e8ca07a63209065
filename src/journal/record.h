// The bytes of a journal: a head of 16 bytes, then records one behind the other, each with a head of its own.
//
//   file head      8 bytes "STRATAJ1", 8 random bytes: the file's id
//   record head    u32 mark, u32 type, u64 bytes of payload, u32 CRC-32 of the payload, u32 CRC-32 of the 20 bytes
//   before payload
//
// Numbers are little-endian. Both checksums begin with the id, so that a record of another journal, which a file system
// may leave in a block that it had no time to write, is not taken for one of this file.
//
// A record is only ever appended. What a crash can do to the file is to cut it, to put zeros or old bytes where the
// system had not yet written, or to flip bits; so a reader trusts a record's length only if its head's checksum is
// right, and its payload only if the payload's is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace strata::journal {

using Bytes = std::span<const unsigned char>;

inline constexpr std::size_t kFileHeadBytes = 16;
inline constexpr std::size_t kRecordHeadBytes = 24;

// Of a file; drawn at random when it is made.
using FileId = std::uint64_t;

std::array<unsigned char, kFileHeadBytes> file_head(FileId id);

// Nothing for other bytes than the head of a journal.
std::optional<FileId> id_of_file_head(Bytes head);

struct RecordHead {
    std::uint32_t type = 0;  // what the payload is; the owner's business
    std::uint64_t length = 0;
    std::uint32_t payload_check = 0;
};

// CRC-32 (zlib's) of the id and then of all parts, as if they were one.
std::uint32_t checksum(FileId id, std::span<const Bytes> parts);

std::array<unsigned char, kRecordHeadBytes> record_head(const RecordHead& head, FileId id);

// Nothing where mark or checksum are not those of a record of this file.
std::optional<RecordHead> parse_record_head(Bytes bytes, FileId id);

}  // namespace strata::journal
