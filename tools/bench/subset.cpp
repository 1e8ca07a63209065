#include "tools/bench/subset.h"

#include <fmt/format.h>

#include <algorithm>

#include "noise/hash.h"
#include "src/sample/sobol.h"

namespace strata::tools::bench {

namespace {

// Above this share of the frame's blocks, the rest is measured too.
constexpr double kNearlyWhole = 0.5;

struct BlockGrid {
    int side, columns, rows;

    BlockGrid(int width, int height, int block)
        : side(block), columns((width + block - 1) / block), rows((height + block - 1) / block) {}
    std::int64_t count() const { return std::int64_t{1} * columns * rows; }
};

std::uint64_t seed_of(const BlockSeeds& seeds, int columns) {
    return columns == 8 ? seeds.of_8 : columns == 15 ? seeds.of_15 : columns == 30 ? seeds.of_30 : seeds.other;
}

int side_of_blocks(int width, int height, std::int64_t samples_a_pixel) {
    int side = kBlockUnit;
    const int longest = std::max(width, height);
    while (side * kMostColumns < longest ||
           (std::int64_t{1} * side * side * samples_a_pixel < kBatchSamples && side < longest)) {
        side *= 2;
    }
    return side;
}

// Index in [0,count) of the part that a 32-bit fraction of `extent` pixels falls into.
int part_of(std::uint32_t fraction, int extent, int side) {
    const auto pixel = static_cast<int>((std::uint64_t{fraction} * static_cast<std::uint64_t>(extent)) >> 32);
    return pixel / side;
}

std::vector<film::Rect> choose_blocks(const BlockGrid& grid, int width, int height, std::int64_t count,
                                      std::uint64_t seed) {
    const std::uint64_t seeds = noise::mix64(seed);
    const auto seed_u = static_cast<std::uint32_t>(seeds >> 32);
    const auto seed_v = static_cast<std::uint32_t>(seeds);
    std::vector<bool> taken(static_cast<std::size_t>(grid.count()));
    std::vector<film::Rect> windows;
    // The sequence visits every block: it fills any grid in the end.
    for (std::uint32_t i = 0; std::ssize(windows) < count; ++i) {
        const auto point = sample::sobol_point(i);
        const int column =
            part_of(sample::owen_scramble_reversed(sample::reverse_bits(point[0]), seed_u), width, grid.side);
        const int row =
            part_of(sample::owen_scramble_reversed(sample::reverse_bits(point[1]), seed_v), height, grid.side);
        const auto index =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
        if (taken[index]) continue;
        taken[index] = true;
        const int x0 = column * grid.side, y0 = row * grid.side;
        windows.push_back({x0, y0, std::min(x0 + grid.side, width), std::min(y0 + grid.side, height)});
    }
    return windows;
}

}  // namespace

std::int64_t Subset::pixels() const {
    std::int64_t sum = 0;
    for (const film::Rect& window : windows) sum += std::int64_t{1} * window.width() * window.height();
    return sum;
}

std::string Subset::text() const {
    return block == 0 ? "whole frame" : fmt::format("{} blocks of {} px", windows.size(), block);
}

Subset blocks_of(int width, int height, int side, std::int64_t count, std::uint64_t seed) {
    const BlockGrid grid(width, height, side);
    return {choose_blocks(grid, width, height, std::min(count, grid.count()), seed), side};
}

Subset subset_of(int width, int height, std::int64_t samples_a_pixel, const SubsetLimits& limits,
                 const BlockSeeds& seeds) {
    const BlockGrid grid(width, height, side_of_blocks(width, height, samples_a_pixel));
    const std::int64_t frame_rays = std::int64_t{1} * width * height * samples_a_pixel;
    const std::int64_t block_rays = std::int64_t{1} * grid.side * grid.side * samples_a_pixel;
    const std::int64_t wanted = std::max<std::int64_t>({limits.rays / block_rays, limits.least_blocks, 1});
    if (frame_rays <= limits.rays || static_cast<double>(wanted) > kNearlyWhole * static_cast<double>(grid.count())) {
        return {{{0, 0, width, height}}, 0};
    }
    return {choose_blocks(grid, width, height, wanted, seed_of(seeds, grid.columns)), grid.side};
}

}  // namespace strata::tools::bench
