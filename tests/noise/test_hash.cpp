#include "noise/hash.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "noise/reference.h"
#include "tests/noise/hash_statistics.h"
#include "tools/stability/oracles/noise_oracle.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

// Both sides of every place where a 32-bit word of the index carries, and far ones.
std::vector<std::int64_t> carry_cells() {
    std::vector<std::int64_t> cells;
    const std::int64_t half = std::int64_t{1} << 31, whole = std::int64_t{1} << 32;
    for (const std::int64_t at : {std::int64_t{0}, half, -half, whole, -whole, whole + half, -whole - half, 7 * whole,
                                  std::int64_t{1} << 40, -(std::int64_t{1} << 51), std::int64_t{1} << 51}) {
        for (std::int64_t k = -3; k <= 3; ++k) cells.push_back(at + k);
    }
    return cells;
}

// How much more often than by chance the selections at a cell and at its shifted copy agree.
template <std::size_t D>
double agreement_deviations(const LatticeKey& key, const Region& region, const Cell<D>& shift,
                            std::mt19937_64& random) {
    constexpr int kSamples = 4096;
    int equal = 0;
    for (int i = 0; i < kSamples; ++i) {
        const Cell<D> cell = random_cell<D>(region, random);
        equal += selection<D>(key, cell) == selection<D>(key, plus<D>(cell, shift));
    }
    const double chance = 1.0 / kChoices<D>;
    return (equal - kSamples * chance) / std::sqrt(kSamples * chance * (1.0 - chance));
}

constexpr std::uint32_t inverse_modulo_2_32(std::uint32_t odd) {
    std::uint32_t inverse = odd;
    for (int i = 0; i < 5; ++i) inverse *= 2u - odd * inverse;
    return inverse;
}

// Shifts on one axis that a multiplicative hash may be blind to: powers of two, and those that the multiplier carries
// to powers of two, with whole blocks of 2^32 on top.
std::vector<std::int64_t> suspect_shifts() {
    std::vector<std::int64_t> shifts;
    for (int k = 12; k < 64; ++k) shifts.push_back(static_cast<std::int64_t>(std::uint64_t{1} << k));
    const std::int64_t inverse = inverse_modulo_2_32(kAxisMultiplier);
    for (int k = 0; k < 32; k += 3) {
        const std::int64_t j = ((inverse << k) & 0xFFFFFFFF);
        shifts.push_back(j);
        shifts.push_back(j - (std::int64_t{1} << 32));
        shifts.push_back(j + (std::int64_t{1} << (33 + k % 20)));
    }
    return shifts;
}

template <std::size_t D>
void check_no_period() {
    const LatticeKey key = lattice_key(1, 0);
    const std::vector<std::int64_t> shifts = suspect_shifts();
    std::mt19937_64 random(D);
    Worst worst;
    for (const Region& region : kRegions) {
        for (std::size_t i = 0; i < shifts.size(); ++i) {
            std::vector<Cell<D>> candidates;
            const std::int64_t s = shifts[i], other = shifts[random() % shifts.size()];
            for (std::size_t a = 0; a < D; ++a) {
                Cell<D> alone{}, equal{}, opposite{}, mixed{};
                const std::size_t b = (a + 1) % D;
                alone[a] = equal[a] = equal[b] = opposite[a] = mixed[a] = s;
                opposite[b] = static_cast<std::int64_t>(-static_cast<std::uint64_t>(s));
                mixed[b] = other;
                candidates.insert(candidates.end(), {alone, equal, opposite, mixed});
            }
            Cell<D> all;
            all.fill(s);
            candidates.push_back(all);
            for (const Cell<D>& shift : candidates) {
                worst.check(agreement_deviations<D>(key, region, shift, random),
                            std::to_string(D) + "-D, cells " + region.name + ", shift " + text<D>(shift));
            }
        }
    }
}

}  // namespace

TEST_CASE("words of lattice planes match the definition, across every carry") {
    std::mt19937_64 random(1);
    const auto check = [&](std::int64_t cell, std::uint32_t key) {
        REQUIRE(plane_word(cell, key) == strata::oracle::detail::plane_hash(cell, key));
        const std::array<std::uint32_t, 2> pair = plane_pair(cell, key);
        REQUIRE(pair[0] == strata::oracle::detail::plane_hash(cell, key));
        REQUIRE(pair[1] == strata::oracle::detail::plane_hash(cell + 1, key));
    };
    for (const std::int64_t cell : carry_cells()) {
        for (int trial = 0; trial < 100; ++trial) check(cell, static_cast<std::uint32_t>(random()));
    }
    for (int trial = 0; trial < 100000; ++trial) {
        check(static_cast<std::int64_t>(random()) >> (random() % 63 + 1), static_cast<std::uint32_t>(random()));
    }
}

TEST_CASE("noise around every carry matches the definition") {
    std::mt19937_64 random(2);
    const std::vector<std::int64_t> cells = carry_cells();
    double worst = 0.0;
    for (int trial = 0; trial < 50000; ++trial) {
        const LatticeKey key = lattice_key(random(), 0);
        LatticePoint<3> at3;
        for (std::size_t a = 0; a < 3; ++a) {
            at3.cell[a] = cells[random() % cells.size()];
            at3.fraction[a] = static_cast<double>(random() % 1024) / 1024.0;
        }
        const LatticePoint<2> at2{{at3.cell[0], at3.cell[1]}, {at3.fraction[0], at3.fraction[1]}};
        std::array<long double, 3> x;
        for (std::size_t a = 0; a < 3; ++a) {
            x[a] = static_cast<long double>(at3.cell[a]) + static_cast<long double>(at3.fraction[a]);
        }
        const long double expected2 = strata::oracle::noise2<long double>(key.axis, x[0], x[1]);
        const long double expected3 = strata::oracle::noise3<long double>(key.axis, x[0], x[1], x[2]);
        worst = std::max(worst, std::abs(static_cast<double>(reference_value<2>(key, at2) - expected2)));
        worst = std::max(worst, std::abs(static_cast<double>(reference_value<3>(key, at3) - expected3)));
    }
    MESSAGE("largest error " << worst);
    CHECK(worst < 1e-14);
}

TEST_CASE("no shift of the lattice repeats its gradients more often than chance") {
    check_no_period<2>();
    check_no_period<3>();
}
