#include "src/integrate/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>

namespace strata::integrate {

namespace {

std::uint32_t mixed(std::uint32_t block) { return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u; }

// The bytes from the lowest up, whatever the machine's order is.
std::uint32_t little_endian(std::string_view bytes) {
    std::uint32_t word = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[i]);
    return word;
}

std::string hex(float id) { return fmt::format("{:08x}", std::bit_cast<std::uint32_t>(id)); }

// Names of layers are letters, digits, '_' and '-', which JSON takes as they are.
std::string manifest(std::span<const std::string> names) {
    std::string entries;
    for (const std::string& name : names)
        entries += fmt::format("{}\"{}\":\"{}\"", entries.empty() ? "" : ",", name, hex(crypto_id(name)));
    return '{' + entries + '}';
}

}  // namespace

std::string crypto_name(std::string_view prefix) {
    return prefix.empty() ? std::string(kCryptoGround) : fmt::format("{}.{}", prefix, kCryptoGround);
}

std::uint32_t murmur_hash(std::string_view bytes) {
    std::uint32_t hash = 0;
    const auto length = static_cast<std::uint32_t>(bytes.size());
    for (; bytes.size() >= 4; bytes.remove_prefix(4))
        hash = std::rotl(hash ^ mixed(little_endian(bytes.substr(0, 4))), 13) * 5 + 0xe6546b64u;
    hash ^= mixed(little_endian(bytes)) ^ length;
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

float crypto_id(std::string_view name) {
    std::uint32_t bits = murmur_hash(name);
    const std::uint32_t exponent = bits >> 23 & 255;
    if (exponent == 0 || exponent == 255) bits ^= 1u << 23;
    return std::bit_cast<float>(bits);
}

std::vector<std::string> crypto_channels(std::string_view mattes, std::size_t names) {
    std::vector<std::string> channels;
    for (std::size_t i = 0; i < crypto_values(names); ++i)
        channels.push_back(fmt::format("{}{:02}.{}", mattes, i / 4, "rgba"[i % 4]));
    return channels;
}

void rank_coverages(std::span<const float> ids, std::span<float> pixel) {
    std::vector<std::pair<float, float>> pairs;
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (pixel[i] > 0.0f) pairs.emplace_back(ids[i], pixel[i]);
    std::ranges::stable_sort(pairs, std::greater{}, &std::pair<float, float>::second);
    std::ranges::fill(pixel, 0.0f);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pixel[2 * i] = pairs[i].first;
        pixel[2 * i + 1] = pairs[i].second;
    }
}

std::vector<std::pair<std::string, std::string>> crypto_header(std::string_view mattes,
                                                               std::span<const std::string> names) {
    const std::string key = "cryptomatte/" + hex(crypto_id(mattes)).substr(0, 7) + '/';
    return {{key + "name", std::string(mattes)},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            {key + "manifest", manifest(names)}};
}

}  // namespace strata::integrate
