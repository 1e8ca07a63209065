#include "noise/hash.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/noise/hash_statistics.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

template <std::size_t D>
void check_uniform() {
    constexpr int kSamples = 65536;
    std::mt19937_64 random(10 + D);
    Worst worst;
    for (const Region& region : kRegions) {
        for (unsigned axes = 0; axes < 1u << D; ++axes) {  // along the axes of the set; scattered for none
            const LatticeKey key = lattice_key(random(), 0);
            const Cell<D> start = random_cell<D>(region, random);
            std::vector<int> counts(kChoices<D>);
            for (int i = 0; i < kSamples; ++i) {
                Cell<D> step{};
                for (std::size_t a = 0; a < D; ++a) step[a] = (axes >> a) & 1 ? i : 0;
                ++counts[selection<D>(key, axes == 0 ? random_cell<D>(region, random) : plus<D>(start, step))];
            }
            worst.check(chi_square_deviations(counts), std::to_string(D) + "-D, " + region.name + ", along axes " +
                                                           std::to_string(axes) + " from " + text<D>(start));
        }
    }
}

template <std::size_t D>
std::vector<Cell<D>> neighbour_offsets() {
    std::vector<Cell<D>> offsets;
    for (int code = 1; code < (D == 2 ? 25 : 125); ++code) {
        Cell<D> offset;
        for (int rest = code, a = 0; a < static_cast<int>(D); ++a, rest /= 5)
            offset[static_cast<std::size_t>(a)] = rest % 5 - 2;
        offsets.push_back(offset);
    }
    std::erase(offsets, Cell<D>{});
    for (int k = 2; k < 63; ++k) {
        for (std::size_t a = 0; a < D; ++a) {
            Cell<D> offset{};
            offset[a] = std::int64_t{1} << k;
            offsets.push_back(offset);
        }
    }
    return offsets;
}

template <std::size_t D>
void check_neighbours() {
    constexpr int kSamples = 1 << 14;
    std::mt19937_64 random(20 + D);
    Worst worst;
    for (const Region& region : kRegions) {
        for (const Cell<D>& offset : neighbour_offsets<D>()) {
            const LatticeKey key = lattice_key(random(), 0);
            const double deviations = joint_deviations<D>(kSamples, [&]() -> std::array<std::uint32_t, 2> {
                const Cell<D> cell = random_cell<D>(region, random);
                return {selection<D>(key, cell), selection<D>(key, plus<D>(cell, offset))};
            });
            worst.check(deviations, std::to_string(D) + "-D, " + region.name + ", offset " + text<D>(offset));
        }
    }
}

// Words of rows and columns are combined by exclusive or, so those of a rectangle's corners cancel: what is left of
// that in the selections of a unit square.
template <std::size_t D>
void check_squares() {
    constexpr int kSamples = 1 << 18;
    std::mt19937_64 random(30 + D);
    Worst worst;
    for (const Region& region : kRegions) {
        const LatticeKey key = lattice_key(random(), 0);
        std::vector<int> exclusive_or(kChoices<D>), sums(kChoices<D>);
        for (int i = 0; i < kSamples; ++i) {
            const Cell<D> cell = random_cell<D>(region, random);
            std::array<std::uint32_t, 4> corner;
            for (std::uint32_t c = 0; c < 4; ++c) {
                Cell<D> offset{};
                offset[0] = c & 1, offset[1] = c >> 1;
                corner[c] = selection<D>(key, plus<D>(cell, offset));
            }
            ++exclusive_or[corner[0] ^ corner[1] ^ corner[2] ^ corner[3]];
            ++sums[(corner[0] - corner[1] - corner[2] + corner[3]) & (kChoices<D> - 1)];
        }
        worst.check(chi_square_deviations(exclusive_or), std::to_string(D) + "-D, exclusive or, " + region.name);
        worst.check(chi_square_deviations(sums), std::to_string(D) + "-D, alternating sum, " + region.name);
    }
}

template <std::size_t D>
void check_keys() {
    constexpr int kSamples = 1 << 14;
    std::mt19937_64 random(40 + D);
    Worst worst;
    const auto compare = [&](const LatticeKey& p, const LatticeKey& q, const std::string& where) {
        const Region& region = kRegions[random() % kRegions.size()];
        worst.check(joint_deviations<D>(kSamples,
                                        [&]() -> std::array<std::uint32_t, 2> {
                                            const Cell<D> cell = random_cell<D>(region, random);
                                            return {selection<D>(p, cell), selection<D>(q, cell)};
                                        }),
                    std::to_string(D) + "-D, " + where + ", " + region.name);
    };
    for (int k = 0; k < 32; ++k) {
        const std::string octave = "octave " + std::to_string(k);
        compare(lattice_key(1, k), lattice_key(1, k + 1), octave + " and the next");
        compare(lattice_key(1, k), lattice_key(2, k), octave + " of seeds 1 and 2");
        compare(lattice_key(0, k), lattice_key(~std::uint64_t{0}, k), octave + " of the least and the largest seed");
        compare(lattice_key(0, k), lattice_key(std::uint64_t{1} << (k + 32), 0),
                octave + " and a seed of one high bit");
    }
    // Exchanged axes.
    for (const Region& region : kRegions) {
        const LatticeKey key = lattice_key(random(), 0);
        worst.check(joint_deviations<D>(kSamples,
                                        [&]() -> std::array<std::uint32_t, 2> {
                                            Cell<D> cell = random_cell<D>(region, random);
                                            const std::uint32_t before = selection<D>(key, cell);
                                            std::swap(cell[0], cell[1]);
                                            return {before, selection<D>(key, cell)};
                                        }),
                    std::to_string(D) + "-D, exchanged axes, " + region.name);
    }
}

}  // namespace

TEST_CASE("all gradients are selected equally often, along axes and diagonals, near and far") {
    check_uniform<2>();
    check_uniform<3>();
}

TEST_CASE("gradients of neighbouring lattice points are selected independently") {
    check_neighbours<2>();
    check_neighbours<3>();
}

TEST_CASE("the corners of a unit square select their gradients independently") {
    check_squares<2>();
    check_squares<3>();
}

TEST_CASE("octaves, seeds and axes select their gradients independently") {
    check_keys<2>();
    check_keys<3>();
}
