// Mattes by Cryptomatte, version 1.2 of the specification by J. Friedman and A. Jones: a pixel holds pairs of a name's
// id and how much of the pixel it covers, the greatest first, and the header tells names from ids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strata::integrate {

// What the mattes of the ground's layers are called in a file.
inline constexpr std::string_view kCryptoGround = "crypto_ground";

// The same with a prefix, if there is one: "View.crypto_ground".
std::string crypto_name(std::string_view prefix);

// MurmurHash3_x86_32 with the seed 0, by A. Appleby.
std::uint32_t murmur_hash(std::string_view bytes);

// The hash as the bits of a float, with the exponents of subnormal numbers and of infinity moved by one to their
// neighbours: libraries of pictures would not keep those.
float crypto_id(std::string_view name);

// Values of a pixel that has mattes of so many names: four for two pairs, which is a layer of the file.
inline constexpr std::size_t crypto_values(std::size_t names) { return 4 * ((names + 1) / 2); }

// "crypto_ground00.r" and so on, in the order of a pixel's values.
std::vector<std::string> crypto_channels(std::string_view mattes, std::size_t names);

// From the coverages of each name, the first values of a pixel, to pairs in their order. Equal coverages keep the
// names' order; what is not covered is 0.
void rank_coverages(std::span<const float> ids, std::span<float> pixel);

// What the header of a file says: the attributes' names and values.
std::vector<std::pair<std::string, std::string>> crypto_header(std::string_view mattes,
                                                               std::span<const std::string> names);

}  // namespace strata::integrate
