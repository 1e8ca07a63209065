#include "src/image/digest.h"

#include <OpenImageIO/hash.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <system_error>

#include "src/image/image_error.h"

namespace strata::image {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLengthDigits = 15;
constexpr std::size_t kLengthAt = 26;  // in a digest's text
constexpr std::size_t kCheckSize = 4;  // of the checksum that ends each chunk of a PNG

std::string digest_text(std::uint64_t hash, std::uint64_t length) {
    return fmt::format("xxh64 {:016x} of {:0{}} bytes", hash, length, kLengthDigits);
}

// How the entry of a digest begins. The zeros of EXR and PNG keep a text from looking like it; TIFF and JPEG may hold
// their description several times over.
std::string entry_start(Format format) {
    using namespace std::string_literals;
    const std::string key(kDigestKey);
    switch (format) {
        case Format::exr:
            return key + "\0string\0"s + static_cast<char>(blank_digest().size()) + "\0\0\0"s;
        case Format::png:
            return "tEXt" + key + "\0"s;
        case Format::tiff:
        case Format::jpeg:
            break;
    }
    return key + " = ";
}

struct Scan {
    std::uint64_t hash = 0;
    std::uint64_t length = 0;
    std::vector<std::int64_t> places;  // of the digest
};

// What is looked for in a file, and how many bytes after `start` count as zeros.
struct Field {
    std::string start, digest;
    std::size_t blanked = 0;
};

Field field_of(Format format, const std::string& digest) {
    return {entry_start(format), digest, digest.size() + (format == Format::png ? kCheckSize : 0)};
}

Scan scan(const ReadBytes& read, const std::optional<Field>& field) {
    constexpr std::size_t kBlock = 1 << 20;
    const std::string sought = field ? field->start + field->digest : "";
    const std::size_t ahead = field ? field->start.size() + field->blanked : 0;
    std::vector<unsigned char> buffer(kBlock + ahead);
    Scan result;
    std::size_t held = 0;
    for (;;) {
        const auto offset = static_cast<std::int64_t>(result.length);
        held += read(offset + static_cast<std::int64_t>(held), std::span(buffer).subspan(held));
        if (held == 0) return result;
        const std::size_t hashed = std::min(held, kBlock);
        const std::string_view text(reinterpret_cast<const char*>(buffer.data()), held);
        for (std::size_t at = field ? text.find(sought) : text.npos; at < hashed; at = text.find(sought, at + 1)) {
            const std::size_t place = at + field->start.size();
            result.places.push_back(offset + static_cast<std::int64_t>(place));
            std::fill_n(buffer.begin() + static_cast<std::ptrdiff_t>(place), std::min(field->blanked, held - place), 0);
        }
        result.hash = OIIO::xxhash::XXH64(buffer.data(), hashed, result.hash);
        result.length += hashed;
        held -= hashed;
        std::copy_n(buffer.begin() + static_cast<std::ptrdiff_t>(hashed), held, buffer.begin());
    }
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
    throw ImageError(fmt::format("cannot read \"{}\": {}", path.string(), error.message()));
}

std::error_code last_error() { return {errno != 0 ? errno : EIO, std::generic_category()}; }

// A file whose reading fails is not one that ends there: a stream tells them apart by its bad bit.
Scan scan_file(const fs::path& path, const std::optional<Field>& field) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, last_error());
    const auto read = [&](std::int64_t, std::span<unsigned char> bytes) {  // one block after the other
        errno = 0;
        file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        if (file.bad()) fail(path, last_error());
        return static_cast<std::size_t>(file.gcount());
    };
    return scan(read, field);
}

std::span<const unsigned char> bytes_of(const std::string& text) {
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

// The checksum of the chunk of a PNG that consists of this text.
std::string chunk_check(const std::string& text) {
    const auto sum = crc32(0, bytes_of(text).data(), static_cast<uInt>(text.size()));
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(sum >> shift & 0xff);
    return bytes;
}

// The length that a digest tells; nothing for what is none or blank.
std::optional<std::uint64_t> length_in(const std::string& digest) {
    if (digest.size() != blank_digest().size() || digest == blank_digest()) return std::nullopt;
    std::uint64_t length = 0;
    const char* begin = digest.data() + kLengthAt;
    const auto [end, error] = std::from_chars(begin, begin + kLengthDigits, length);
    if (error != std::errc() || end != begin + kLengthDigits) return std::nullopt;
    return length;
}

}  // namespace

std::string blank_digest() { return digest_text(0, 0); }

void put_digest(Format format, const ReadBytes& read, const WriteBytes& write) {
    const Field field = field_of(format, blank_digest());
    const Scan scanned = scan(read, field);
    std::string digest = digest_text(scanned.hash, scanned.length);
    if (format == Format::png) digest += chunk_check(field.start + digest);
    for (const std::int64_t place : scanned.places) write(place, bytes_of(digest));
}

void put_digest(Format format, std::vector<unsigned char>& bytes) {
    const auto read = [&](std::int64_t offset, std::span<unsigned char> part) {
        const std::size_t count = std::min(part.size(), bytes.size() - static_cast<std::size_t>(offset));
        std::copy_n(bytes.begin() + offset, count, part.begin());
        return count;
    };
    put_digest(format, read, [&](std::int64_t offset, std::span<const unsigned char> part) {
        std::ranges::copy(part, bytes.begin() + offset);
    });
}

Integrity check_digest(const fs::path& path, Format format, const std::optional<std::string>& digest) {
    const std::optional<std::uint64_t> length = digest ? length_in(*digest) : std::nullopt;
    if (!length) return Integrity::unknown;
    std::error_code error;
    const std::uint64_t size = fs::file_size(path, error);
    if (error) fail(path, error);
    if (size != *length) return Integrity::another_length;
    const Scan scanned = scan_file(path, field_of(format, *digest));
    return digest_text(scanned.hash, scanned.length) == *digest ? Integrity::whole : Integrity::damaged;
}

std::string digest_of_file(const fs::path& path) {
    const Scan scanned = scan_file(path, std::nullopt);
    return digest_text(scanned.hash, scanned.length);
}

}  // namespace strata::image
