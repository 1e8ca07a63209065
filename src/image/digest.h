// A picture file's checksum of its own bytes, which it carries among its metadata: damage is found without decoding,
// in every format alike.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/image/format.h"

namespace strata::image {

inline constexpr std::string_view kDigestKey = "strata:digest";

// What is written for the digest while the file's bytes are not all known.
std::string blank_digest();

// Reads as many bytes from an offset as there are, at most as many as fit.
using ReadBytes = std::function<std::size_t(std::int64_t offset, std::span<unsigned char>)>;
using WriteBytes = std::function<void(std::int64_t offset, std::span<const unsigned char>)>;

// Puts the digest of a finished file in place of the blank. Nothing may change a byte after it.
void put_digest(Format format, const ReadBytes& read, const WriteBytes& write);
void put_digest(Format format, std::vector<unsigned char>& bytes);

enum class Integrity {
    whole,           // every byte is as it was written
    damaged,         // as many bytes as were written, and others
    another_length,  // cut, or written anew by a program that passes metadata on
    unknown          // it carries no digest
};

// `digest` is what the file says. Throws ImageError where the file cannot be read to its end.
Integrity check_digest(const std::filesystem::path& path, Format format, const std::optional<std::string>& digest);

// Of any file, to be kept beside it: "xxh64 0123456789abcdef of 000000000001234 bytes".
// Throws ImageError where it cannot be read to its end.
std::string digest_of_file(const std::filesystem::path& path);

}  // namespace strata::image
