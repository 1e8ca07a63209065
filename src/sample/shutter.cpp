#include "src/sample/shutter.h"

#include "src/sample/counter_hash.h"
#include "src/sample/permutation.h"
#include "src/sample/strata.h"

namespace strata::sample {

void folded_times(std::uint64_t cell_key, std::span<std::uint32_t> permutation, std::span<float> q) {
    const std::uint64_t key = stream_key(cell_key, Stream::time);
    draw_permutation(key, permutation);
    const auto n = static_cast<std::uint32_t>(permutation.size());
    for (std::uint32_t i = 0; i < n; ++i) q[i] = folded_stratum(permutation[i], n, low_word(counter_hash(key, i)));
}

void folded_random_times(std::uint64_t cell_key, std::span<float> q) {
    const std::uint64_t key = stream_key(cell_key, Stream::time);
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = folded_stratum(0, 1, low_word(counter_hash(key, i)));
}

}  // namespace strata::sample
