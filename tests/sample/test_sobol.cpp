#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "src/sample/counter_hash.h"
#include "src/sample/sobol.h"

using namespace strata::sample;

namespace {

// Whether the points fill every elementary box of area 2^-bits exactly once.
bool is_net(const std::vector<std::uint32_t>& u, const std::vector<std::uint32_t>& v, int bits) {
    for (int columns = 0; columns <= bits; ++columns) {
        std::vector<bool> filled(u.size(), false);
        for (std::size_t i = 0; i < u.size(); ++i) {
            const std::uint64_t column = static_cast<std::uint64_t>(u[i]) >> (32 - columns);
            const std::uint64_t row = static_cast<std::uint64_t>(v[i]) >> (32 - (bits - columns));
            const std::uint64_t box = (column << (bits - columns)) | row;
            if (filled[box]) return false;
            filled[box] = true;
        }
    }
    return true;
}

}  // namespace

TEST_CASE("the sequence begins as Sobol's") {
    const std::uint32_t quarter = 0x40000000u;
    const std::vector<std::array<std::uint32_t, 2>> first = {
        {0, 0}, {2 * quarter, 2 * quarter}, {quarter, 3 * quarter}, {3 * quarter, quarter}};
    for (std::uint32_t i = 0; i < 4; ++i) CHECK(sobol_point(i) == first[i]);
}

TEST_CASE("scrambled points are a (0,2)-net at 16, 64, 256 and 4096 points for every seed") {
    for (const int bits : {4, 6, 8, 12}) {
        const SobolTable table(1u << bits);
        const int seeds = bits == 12 ? 20 : 300;
        for (int seed = 0; seed < seeds; ++seed) {
            const std::uint64_t words = counter_hash(cell_key(1, seed, bits), 0);
            std::vector<std::uint32_t> u;
            std::vector<std::uint32_t> v;
            for (std::uint32_t i = 0; i < table.size(); ++i) {
                u.push_back(table.scrambled_u(i, high_word(words)));
                v.push_back(table.scrambled_v(i, low_word(words)));
            }
            REQUIRE(is_net(u, v, bits));
        }
    }
    // The check itself can fail: the same points with one coordinate reversed in order of bits are no net.
    std::vector<std::uint32_t> u;
    for (std::uint32_t i = 0; i < 16; ++i) u.push_back(reverse_bits(i));
    CHECK(!is_net(u, u, 4));
}

TEST_CASE("over seeds each scrambled point is uniform in the square") {
    const SobolTable table(16);
    const int seeds = 40000;
    const int bins = 32;
    for (const std::uint32_t point : {0u, 1u, 7u, 15u}) {
        std::vector<int> u(bins, 0);
        std::vector<int> v(bins, 0);
        std::vector<int> joint(8 * 8, 0);
        for (int seed = 0; seed < seeds; ++seed) {
            const std::uint64_t words = counter_hash(cell_key(2, seed, 0), 0);
            const std::uint32_t x = table.scrambled_u(point, high_word(words));
            const std::uint32_t y = table.scrambled_v(point, low_word(words));
            ++u[x >> 27];
            ++v[y >> 27];
            ++joint[(x >> 29) * 8 + (y >> 29)];
        }
        const auto z = [&](const std::vector<int>& counts) {
            const double expected = seeds / static_cast<double>(counts.size());
            double chi_square = 0;
            for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
            const double freedom = static_cast<double>(counts.size()) - 1;
            return (chi_square - freedom) / std::sqrt(2 * freedom);
        };
        MESSAGE("point ", point, ": chi-square ", z(u), ", ", z(v), ", joint ", z(joint), " sigma");
        CHECK(z(u) < 4);
        CHECK(z(v) < 4);
        CHECK(z(joint) < 4);
    }
}

TEST_CASE("bits after the first four depend on the prefix: siblings are scrambled apart") {
    // Points 0 and 8 share a coarse half and differ in the fourth bit; what follows must agree no more than by chance.
    int agreements = 0;
    const int seeds = 20000;
    const SobolTable table(16);
    for (int seed = 0; seed < seeds; ++seed) {
        const auto word = static_cast<std::uint32_t>(counter_hash(cell_key(5, seed, 0), 0));
        const std::uint32_t a = table.scrambled_u(0, word) << 4;
        const std::uint32_t b = table.scrambled_u(8, word) << 4;
        agreements += (a >> 31) == (b >> 31) ? 1 : 0;
    }
    const double z = (agreements - seeds / 2.0) / std::sqrt(seeds / 4.0);
    MESSAGE("agreement of siblings: ", z, " sigma");
    CHECK(std::fabs(z) < 4);
}
