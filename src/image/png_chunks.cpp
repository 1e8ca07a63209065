#include "src/image/png_chunks.h"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <fstream>

namespace strata::image {
namespace {

constexpr std::size_t kTypeSize = 4, kChunkCheckSize = 4;

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(number >> shift & 0xff);
    return bytes;
}

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t number = 0;
    for (const char c : bytes) number = number << 8 | static_cast<unsigned char>(c);
    return number;
}

// How many bytes the UTF-8 character takes that a byte begins; 0 for a byte that begins none.
std::size_t utf8_length(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first < 0xe0) return 2;
    if (first >= 0xe0 && first < 0xf0) return 3;
    return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = utf8_length(static_cast<unsigned char>(text[0]));
        if (length == 0 || length > text.size()) return false;
        for (const char c : text.substr(1, length - 1))
            if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) return false;
        text.remove_prefix(length);
    }
    return true;
}

}  // namespace

std::optional<std::string> find_png_chunk(const std::filesystem::path& png, std::string_view type) {
    constexpr std::uint32_t kLongest = 1 << 16;
    std::ifstream file(png, std::ios::binary);
    file.seekg(8);  // the signature
    std::array<char, 4 + kTypeSize> head{};
    while (file.read(head.data(), head.size())) {
        const std::uint32_t length = big_endian({head.data(), 4});
        const std::string_view found(head.data() + 4, kTypeSize);
        if (found == "IDAT" || found == "IEND") return std::nullopt;
        if (found == type) {
            if (length > kLongest) return std::nullopt;
            std::string data(length, '\0');
            if (!file.read(data.data(), static_cast<std::streamsize>(length))) return std::nullopt;
            return data;
        }
        file.seekg(static_cast<std::streamoff>(length) + static_cast<std::streamoff>(kChunkCheckSize), std::ios::cur);
    }
    return std::nullopt;
}

std::string png_chunk(std::string_view type, std::string_view data) {
    std::string checked(type);
    checked += data;
    const auto* bytes = reinterpret_cast<const unsigned char*>(checked.data());
    const auto check = static_cast<std::uint32_t>(crc32_z(0, bytes, checked.size()));
    return big_endian(static_cast<std::uint32_t>(data.size())) + checked + big_endian(check);
}

bool needs_utf8_chunk(std::string_view text) {
    bool is_ascii = true;
    for (const char c : text) is_ascii &= static_cast<unsigned char>(c) < 0x80;
    return !is_ascii && is_utf8(text);
}

std::string utf8_text_chunk(std::string_view keyword, std::string_view text) {
    std::string data(keyword);
    data += '\0';          // the keyword's end
    data += {'\0', '\0'};  // not compressed, by the one method there is
    data += {'\0', '\0'};  // no language, no translated keyword
    data += text;
    return png_chunk("iTXt", data);
}

}  // namespace strata::image
