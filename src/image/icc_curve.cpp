#include "src/image/icc_curve.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace strata::image {
namespace {

// Layout of ICC.1:2010: a header of 128 bytes, the number of tags, and for each its name, offset and size.
constexpr std::size_t kTagCountAt = 128, kTagsAt = 132, kTagSize = 12;
constexpr std::size_t kMostTags = 1000;

using Bytes = std::span<const unsigned char>;

// Big-endian; zero beyond the end.
std::uint32_t number(Bytes bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + size; ++i) value = value << 8 | (i < bytes.size() ? bytes[i] : 0u);
    return value;
}

bool is_at(Bytes bytes, std::size_t at, std::string_view name) {
    if (at + name.size() > bytes.size()) return false;
    for (std::size_t i = 0; i < name.size(); ++i)
        if (bytes[at + i] != static_cast<unsigned char>(name[i])) return false;
    return true;
}

std::optional<double> power_of_curve(Bytes curve) {
    constexpr std::size_t kCurveHead = 12;
    if (curve.size() < kCurveHead) return std::nullopt;
    if (is_at(curve, 0, "curv")) {
        const std::uint32_t count = number(curve, 8, 4);
        if (count == 0) return 1.0;
        if (count == 1) return number(curve, 12, 2) / 256.0;
        // A table of two values is a straight line from the first to the second.
        if (count == 2 && number(curve, 12, 2) == 0 && number(curve, 14, 2) == 0xffff) return 1.0;
    }
    // Of the parametric curves the first alone is a power and nothing else.
    if (is_at(curve, 0, "para") && number(curve, 8, 2) == 0)
        return static_cast<std::int32_t>(number(curve, 12, 4)) / 65536.0;
    return std::nullopt;
}

}  // namespace

std::optional<double> power_of_icc(Bytes profile) {
    const std::size_t count = number(profile, kTagCountAt, 4);
    if (count > kMostTags) return std::nullopt;
    for (std::size_t tag = kTagsAt; tag < kTagsAt + count * kTagSize; tag += kTagSize) {
        if (!is_at(profile, tag, "rTRC") && !is_at(profile, tag, "kTRC")) continue;
        const std::size_t offset = number(profile, tag + 4, 4);
        if (offset >= profile.size()) return std::nullopt;
        const std::optional<double> power = power_of_curve(profile.subspan(offset));
        return power && *power > 0 ? power : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace strata::image
