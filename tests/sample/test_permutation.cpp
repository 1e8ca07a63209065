#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <vector>

#include "src/sample/counter_hash.h"
#include "src/sample/permutation.h"

using namespace strata::sample;

namespace {

std::vector<std::uint32_t> permutation(std::uint64_t key, std::size_t n) {
    std::vector<std::uint32_t> order(n, ~0u);
    draw_permutation(key, order);
    return order;
}

// Chi-square in standard deviations from its mean, for `cells` equally likely cells.
double chi_square_z(const std::vector<int>& counts, double expected) {
    double chi_square = 0;
    for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
    const double freedom = static_cast<double>(counts.size()) - 1;
    return (chi_square - freedom) / std::sqrt(2 * freedom);
}

}  // namespace

TEST_CASE("every n in 1..4096 gives a bijection, the same for the same key") {
    for (std::size_t n = 1; n <= 4096; ++n) {
        const auto order = permutation(cell_key(3, static_cast<std::int64_t>(n), 5), n);
        std::vector<bool> seen(n, false);
        std::size_t distinct = 0;
        for (const std::uint32_t i : order) {
            if (i >= n || seen[i]) continue;
            seen[i] = true;
            ++distinct;
        }
        REQUIRE(distinct == n);
        if (n % 97 == 0) REQUIRE(order == permutation(cell_key(3, static_cast<std::int64_t>(n), 5), n));
    }
}

TEST_CASE("all 120 permutations of 5 are equally frequent over keys of neighbouring pixels") {
    std::map<std::vector<std::uint32_t>, int> frequency;
    const int draws = 120 * 500;
    for (int i = 0; i < draws; ++i) ++frequency[permutation(cell_key(1, i % 300, i / 300), 5)];
    REQUIRE(frequency.size() == 120);
    std::vector<int> counts;
    for (const auto& [order, count] : frequency) counts.push_back(count);
    const double z = chi_square_z(counts, draws / 120.0);
    MESSAGE("chi-square of permutations of 5: ", z, " sigma");
    CHECK(std::fabs(z) < 4);
}

TEST_CASE("every position receives every value equally often") {
    for (const std::size_t n : {std::size_t{2}, std::size_t{9}, std::size_t{16}, std::size_t{100}}) {
        const int draws = 4000;
        std::vector<int> counts(n * n, 0);
        for (int i = 0; i < draws; ++i) {
            const auto order = permutation(cell_key(9, i, 0), n);
            for (std::size_t position = 0; position < n; ++position) ++counts[position * n + order[position]];
        }
        const double z = chi_square_z(counts, draws / static_cast<double>(n));
        MESSAGE("n = ", n, ": chi-square of positions by values: ", z, " sigma");
        CHECK(z < 5);
    }
}
