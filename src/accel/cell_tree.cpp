#include "src/accel/cell_tree.h"

#include <algorithm>
#include <array>
#include <bit>

namespace strata::accel {

// By digits, the least first; each pass keeps the order of equal ones.
template <class Code>
void SortedCodes::Keys<Code>::sort(int bits) {
    constexpr int kDigit = 11;
    scratch.resize(keys.size());
    for (int shift = 0; shift < bits; shift += kDigit) {
        std::array<std::uint32_t, (1u << kDigit) + 1> start{};
        const auto digit = [&](const Key& key) { return key.code >> shift & ((1u << kDigit) - 1); };
        for (const Key& key : keys) ++start[digit(key) + 1];
        for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
        for (const Key& key : keys) scratch[start[digit(key)]++] = key;
        keys.swap(scratch);
    }
}

template <class Code>
void SortedCodes::sort_by(Keys<Code>& sorted, std::uint64_t least, int bits) {
    sorted.keys.resize(codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i) {
        sorted.keys[i] = {static_cast<Code>(codes[i] - least), static_cast<std::uint32_t>(i)};
    }
    sorted.sort(bits);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        codes[i] = least + sorted.keys[i].code;
        order[i] = sorted.keys[i].ray;
    }
}

void SortedCodes::sort() {
    order.resize(codes.size());
    if (codes.empty()) return;
    const auto [least, most] = std::ranges::minmax(codes);
    const int bits = static_cast<int>(std::bit_width(most - least));
    if (bits <= 32) return sort_by(near_, least, bits);
    sort_by(scattered_, least, bits);
}

}  // namespace strata::accel
