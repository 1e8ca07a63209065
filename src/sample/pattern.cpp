#include "src/sample/pattern.h"

#include <cstddef>

#include "src/sample/counter_hash.h"
#include "src/sample/strata.h"

namespace strata::sample {

namespace {

// f(word) of both coordinates of sample i, where `stratum_of(i, n, word)` places word in stratum i of n.
template <typename StratumOf>
void fill(PatternKind kind, std::uint32_t N, const SobolTable& sobol, std::uint64_t cell_key, std::span<float> u,
          std::span<float> v, StratumOf stratum_of) {
    const std::uint64_t key = stream_key(cell_key, Stream::space);
    if (kind == PatternKind::sobol) {
        const std::uint64_t seeds = counter_hash(key, 0);
        for (std::uint32_t i = 0; i < sobol.size(); ++i) {
            u[i] = stratum_of(0, 1, sobol.scrambled_u(i, high_word(seeds)));
            v[i] = stratum_of(0, 1, sobol.scrambled_v(i, low_word(seeds)));
        }
        return;
    }
    const bool stratified = kind == PatternKind::stratified;
    const std::uint32_t strata = stratified ? N : 1;
    std::uint32_t i = 0;
    for (std::uint32_t row = 0; row < N; ++row) {
        for (std::uint32_t column = 0; column < N; ++column, ++i) {
            const std::uint64_t hash = counter_hash(key, i);
            u[i] = stratum_of(stratified ? column : 0, strata, high_word(hash));
            v[i] = stratum_of(stratified ? row : 0, strata, low_word(hash));
        }
    }
}

}  // namespace

Pattern::Pattern(PatternKind kind, int samples_per_side)
    : kind_(kind), N_(static_cast<std::uint32_t>(samples_per_side)), sobol_(kind == PatternKind::sobol ? N_ * N_ : 0) {}

void Pattern::folded(std::uint64_t cell_key, std::span<float> u, std::span<float> v) const {
    fill(kind_, N_, sobol_, cell_key, u, v,
         [](std::uint32_t i, std::uint32_t n, std::uint32_t word) { return folded_stratum(i, n, word); });
}

void Pattern::positions(std::uint64_t cell_key, std::span<float> u, std::span<float> v) const {
    fill(kind_, N_, sobol_, cell_key, u, v,
         [](std::uint32_t i, std::uint32_t n, std::uint32_t word) { return stratum(i, n, word); });
}

}  // namespace strata::sample
