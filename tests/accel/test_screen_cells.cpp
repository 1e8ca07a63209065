// The hierarchy of screen cells, against division by sides that are powers of two and so exact.
#include "src/accel/screen_cells.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "tests/support/random.h"

using namespace strata;
using namespace strata::accel;

namespace {

using support::Random;
using support::uniform;

struct Sample {
    double u, v, t;
};

// A hierarchy, the frame it is for and its shutter.
struct Case {
    double leaf;
    double frame;  // side, px
    int time_bits;
    scene::TimeSpan shutter;

    ScreenHierarchy hierarchy() const { return {leaf, time_bits, shutter}; }
};

// Leaves as fine as a frame of this size allows, and coarser ones.
std::vector<Case> cases() {
    std::vector<Case> all;
    for (const double frame : {1.0, 64.0, 1920.0, 65536.0}) {
        const double finest = std::max(0x1p-6, std::exp2(std::ceil(std::log2(frame * 0x1p-23))));
        for (const double leaf : {finest, 0.25, 1.0, 8.0, 64.0}) {
            for (int bits = 0; bits <= ScreenHierarchy::kMostTimeBits; ++bits) {
                all.push_back({leaf, frame, bits, {0.0, 0.04}});
                all.push_back({leaf, frame, bits, {-1003.25, -1003.25 + 1.0 / 3.0}});
            }
        }
    }
    return all;
}

// Anywhere about the frame, negative coordinates too; on edges of cells or just beside them; close to one another.
std::vector<Sample> samples(Random& random, const Case& c, std::size_t count) {
    std::vector<Sample> all;
    const auto coordinate = [&](double near) {
        switch (random() % 4) {
            case 0: {
                const double side = std::ldexp(c.leaf, static_cast<int>(random() % 8));
                const double edge = side * std::round(uniform(random, -0.5, 1.5) * c.frame / side);
                const double beyond = random() % 2 == 0 ? -1.0 : 1.0;
                if (edge == 0.0) return 1e-300 * beyond;  // the very next would vanish in a division
                return random() % 2 == 0 ? edge : std::nextafter(edge, 1e9 * beyond);
            }
            case 1:
                return near + uniform(random, -2.0, 2.0) * c.leaf;
            default:
                return uniform(random, -0.5, 1.5) * c.frame;
        }
    };
    const auto time = [&] {
        if (random() % 4 != 0) return uniform(random, c.shutter.first, c.shutter.last);
        const double part = static_cast<double>(random() % 4097) / 4096.0;  // where intervals meet, and both ends
        return std::clamp(std::lerp(c.shutter.first, c.shutter.last, part), c.shutter.first, c.shutter.last);
    };
    all.push_back({0.0, 0.0, c.shutter.first});
    while (all.size() < count) {
        const Sample& near = all[random() % all.size()];
        all.push_back({coordinate(near.u), coordinate(near.v), time()});
        if (random() % 8 == 0) all.push_back(all.back());
    }
    return all;
}

// What a cell is called: its corner in sides, and the first of its times.
using Name = std::tuple<double, double, double>;

Name name_of(const ScreenCell& cell) { return {cell.x / cell.side, cell.y / cell.side, cell.time.first}; }

bool contains(const ScreenCell& cell, const Sample& s) {
    return s.u >= cell.x && s.u < cell.x + cell.side && s.v >= cell.y && s.v < cell.y + cell.side &&
           s.t >= cell.time.first && s.t <= cell.time.last;
}

}  // namespace

TEST_CASE("every sample lies in its cell at every level, in space and in time, and the cells' edges are multiples") {
    Random random(81);
    for (const Case& c : cases()) {
        const ScreenHierarchy hierarchy = c.hierarchy();
        CAPTURE(c.leaf);
        CAPTURE(c.frame);
        CAPTURE(c.time_bits);
        int outside = 0, elsewhere = 0, too_long = 0;
        for (const Sample& s : samples(random, c, 60)) {
            const std::uint64_t code = hierarchy.code(s.u, s.v, s.t);
            for (int level = 0; level < hierarchy.levels(); ++level) {
                const ScreenCell cell = hierarchy.cell(code >> hierarchy.shift(level), level);
                outside += !contains(cell, s);
                elsewhere += cell.side != hierarchy.side(level) || cell.x != std::floor(s.u / cell.side) * cell.side ||
                             cell.y != std::floor(s.v / cell.side) * cell.side;
                const double parts = std::exp2(std::max(0, c.time_bits - 2 * level));
                const double length = (c.shutter.last - c.shutter.first) / parts;
                too_long += cell.time.last - cell.time.first > length + 1e-8 * (c.shutter.last - c.shutter.first);
            }
        }
        CHECK(outside == 0);
        CHECK(elsewhere == 0);
        CHECK(too_long == 0);
    }
}

TEST_CASE("sides grow fourfold to 64 px at least, and the coarsest cells span the shutter") {
    for (const Case& c : cases()) {
        const ScreenHierarchy hierarchy = c.hierarchy();
        CHECK(hierarchy.side(0) == c.leaf);
        CHECK(hierarchy.shift(0) == 0);
        for (int level = 1; level < hierarchy.levels(); ++level) {
            CHECK(hierarchy.side(level) == 4.0 * hierarchy.side(level - 1));
            CHECK(hierarchy.shift(level) >= hierarchy.shift(level - 1) + 4);
            CHECK(hierarchy.shift(level) <= hierarchy.shift(level - 1) + 6);
        }
        const int top = hierarchy.levels() - 1;
        CHECK(hierarchy.side(top) >= 64.0);
        const ScreenCell cell = hierarchy.cell(hierarchy.code(0.0, 0.0, c.shutter.first) >> hierarchy.shift(top), top);
        CHECK(cell.time.first <= c.shutter.first);
        CHECK(cell.time.last >= c.shutter.last);
    }
}

TEST_CASE(
    "samples share a shifted code where they share a cell, and only there, and cells of a level lie in their parents") {
    Random random(82);
    for (const Case& c : cases()) {
        const ScreenHierarchy hierarchy = c.hierarchy();
        CAPTURE(c.leaf);
        CAPTURE(c.time_bits);
        const std::vector<Sample> all = samples(random, c, 40);
        int disagreements = 0, not_nested = 0;
        for (int level = 0; level < hierarchy.levels(); ++level) {
            for (const Sample& a : all) {
                const std::uint64_t code = hierarchy.code(a.u, a.v, a.t) >> hierarchy.shift(level);
                const ScreenCell cell = hierarchy.cell(code, level);
                for (const Sample& b : all) {
                    const std::uint64_t other = hierarchy.code(b.u, b.v, b.t) >> hierarchy.shift(level);
                    disagreements += (code == other) != (name_of(cell) == name_of(hierarchy.cell(other, level)));
                }
                if (level + 1 == hierarchy.levels()) continue;
                const ScreenCell parent =
                    hierarchy.cell(hierarchy.code(a.u, a.v, a.t) >> hierarchy.shift(level + 1), level + 1);
                const double slack = 1e-12 * (std::abs(parent.time.first) + 1.0);
                not_nested += cell.x < parent.x || cell.x + cell.side > parent.x + parent.side || cell.y < parent.y ||
                              cell.y + cell.side > parent.y + parent.side ||
                              cell.time.first < parent.time.first - slack || cell.time.last > parent.time.last + slack;
            }
        }
        CHECK(disagreements == 0);
        CHECK(not_nested == 0);
    }
}

TEST_CASE("sorting puts codes in order, keeps the order of equal ones and loses none, for any number of samples") {
    Random random(83);
    SortedCodes sorted;  // its memory is used again
    for (const Case& c : cases()) {
        const ScreenHierarchy hierarchy = c.hierarchy();
        const std::size_t count = random() % 3 == 0 ? random() % 3 : 1 + random() % 700;
        std::vector<Sample> all = samples(random, c, count);
        all.resize(count, {0.0, 0.0, c.shutter.first});
        if (random() % 8 == 0) std::ranges::fill(all, Sample{1.5, -2.5, c.shutter.first});
        std::vector<double> u, v, t;
        std::vector<std::uint64_t> codes;
        for (const Sample& s : all) {
            u.push_back(s.u), v.push_back(s.v), t.push_back(s.t);
            codes.push_back(hierarchy.code(s.u, s.v, s.t));
        }
        std::vector<std::uint32_t> expected(count);
        std::iota(expected.begin(), expected.end(), 0u);
        std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return codes[i]; });
        sorted.codes.resize(count);
        hierarchy.codes(u, v, t, sorted.codes);
        sorted.sort();
        REQUIRE(sorted.order == expected);
        for (std::size_t i = 0; i < count; ++i) REQUIRE(sorted.codes[i] == codes[expected[i]]);
    }
}
