// Samples of the gradients that the lattice hash selects, and statistics of them. Thresholds are at 6 standard
// deviations of what independent uniform selections would give, which the few thousand statistics of fixed seeds here
// would pass once in 10^5 runs.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "noise/hash.h"

namespace strata::noise::test {

inline constexpr double kDeviations = 6.0;

template <std::size_t D>
using Cell = std::array<std::int64_t, D>;

template <std::size_t D>
constexpr std::uint32_t kChoices = D == 2 ? 8 : 16;

// Number of the gradient at a lattice point.
template <std::size_t D>
std::uint32_t selection(const LatticeKey& key, const Cell<D>& cell) {
    std::uint32_t word = 0;
    for (std::size_t a = 0; a < D; ++a) word ^= plane_word(cell[a], key.axis[a]);
    return (corner_hash(word) >> kGradientShift) & (kChoices<D> - 1);
}

template <std::size_t D>
Cell<D> plus(Cell<D> cell, const Cell<D>& shift) {
    for (std::size_t a = 0; a < D; ++a) {
        cell[a] = static_cast<std::int64_t>(static_cast<std::uint64_t>(cell[a]) + static_cast<std::uint64_t>(shift[a]));
    }
    return cell;
}

template <std::size_t D>
std::string text(const Cell<D>& cell) {
    std::string result = "(";
    for (const std::int64_t index : cell) result += std::to_string(index) + " ";
    result.back() = ')';
    return result;
}

// Where cells are drawn from, each axis alike.
struct Region {
    const char* name;
    std::int64_t low;
    std::uint64_t size;  // 0: all of int64
};

inline constexpr std::array<Region, 4> kRegions = {{{"below the origin", -(1 << 20), 1u << 20},
                                                    {"above the origin", 0, 1u << 20},
                                                    {"around 2^51", (std::int64_t{1} << 51) - (1 << 19), 1u << 20},
                                                    {"anywhere", std::numeric_limits<std::int64_t>::min(), 0}}};

template <std::size_t D>
Cell<D> random_cell(const Region& region, std::mt19937_64& random) {
    Cell<D> cell;
    for (std::int64_t& index : cell) {
        const std::uint64_t draw = region.size == 0 ? random() : random() % region.size;
        index = static_cast<std::int64_t>(static_cast<std::uint64_t>(region.low) + draw);
    }
    return cell;
}

// Deviations of a chi-square statistic from its mean, by Wilson and Hilferty's cube root.
inline double chi_square_deviations(const std::vector<int>& counts) {
    double total = 0.0;
    for (const int count : counts) total += count;
    const double expected = total / static_cast<double>(counts.size());
    double sum = 0.0;
    for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
    const double freedom = static_cast<double>(counts.size()) - 1.0;
    const double spread = 2.0 / (9.0 * freedom);
    return (std::cbrt(sum / freedom) - (1.0 - spread)) / std::sqrt(spread);
}

// Deviations from independence and uniformity of the pairs that `pair` draws.
template <std::size_t D, class Pair>
double joint_deviations(int samples, const Pair& pair) {
    std::vector<int> counts(kChoices<D> * kChoices<D>);
    for (int i = 0; i < samples; ++i) {
        const std::array<std::uint32_t, 2> chosen = pair();
        ++counts[chosen[0] * kChoices<D> + chosen[1]];
    }
    return chi_square_deviations(counts);
}

// Keeps the worst of many statistics for the log.
class Worst {
  public:
    void check(double deviations, const std::string& where) {
        if (deviations > deviations_) deviations_ = deviations, where_ = where;
        if (deviations <= kDeviations) return;
        if (++failures_ <= 8) FAIL_CHECK(where << ": " << deviations << " standard deviations");
    }
    ~Worst() { MESSAGE("worst: " << deviations_ << " of " << kDeviations << " deviations, " << where_); }

  private:
    double deviations_ = -1e9;
    int failures_ = 0;
    std::string where_;
};

}  // namespace strata::noise::test
