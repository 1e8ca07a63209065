// Permutations drawn by a key: all n! of them alike, as far as a 64-bit hash can tell.
#pragma once

#include <cstdint>
#include <span>

#include "src/sample/counter_hash.h"

namespace strata::sample {

// Fills `permutation` with 0..n-1 (n < 2^32) in the order drawn by a stream's key: the inside-out form of the
// Fisher-Yates shuffle (Knuth, The Art of Computer Programming 2, 3.4.2, algorithm P). Step i takes the high word of
// counter_hash(key, i); the low words are left for the caller.
inline void draw_permutation(std::uint64_t stream_key, std::span<std::uint32_t> permutation) {
    for (std::uint32_t i = 0; i < permutation.size(); ++i) {
        const std::uint64_t word = high_word(counter_hash(stream_key, i));
        const std::uint64_t slot = (word * (i + std::uint64_t{1})) >> 32;
        permutation[i] = permutation[slot];
        permutation[slot] = i;
    }
}

}  // namespace strata::sample
