// Bits in a few letters: equal digests mean equal bits but for one chance in 2^64.
#pragma once

#include <fmt/format.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <span>
#include <string>

namespace strata::golden {

// CRC-64 as xz has it, of the bytes as they lie in memory.
template <class T>
std::uint64_t digest(std::span<const T> values) {
    boost::crc_optimal<64, 0x42F0E1EBA9EA3693, 0xFFFFFFFFFFFFFFFF, 0xFFFFFFFFFFFFFFFF, true, true> crc;
    crc.process_bytes(values.data(), values.size_bytes());
    return crc.checksum();
}

template <class T>
std::string digest_text(std::span<const T> values) {
    return fmt::format("{:016x}", digest(values));
}

}  // namespace strata::golden
