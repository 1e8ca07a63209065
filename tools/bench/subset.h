// Which part of a frame is measured: all of it, or whole blocks spread evenly over it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/film/film.h"

namespace strata::tools::bench {

// Blocks are squares of kBlockUnit pixels or a power of two times that, aligned to the frame's origin: the engine
// shares work within such blocks, so that a block costs what it does in the whole frame.
inline constexpr int kBlockUnit = 64;
// A wider frame has larger blocks.
inline constexpr int kMostColumns = 32;
// Samples that the engine takes at once: a block holds at least as many, where the frame does.
inline constexpr std::int64_t kBatchSamples = 65536;

struct SubsetLimits {
    std::int64_t rays = 1'000'000;  // wanted at most; kept to within a block
    int least_blocks = 16;          // even if they have more rays
};

// Of the choice among a grid's blocks, by its columns: as many as frames of 16:9 and up to 480, 960 and 1920 px wide
// have in the smallest blocks. Grids of other columns take `other`.
struct BlockSeeds {
    std::uint64_t of_8 = 1, of_15 = 1, of_30 = 1, other = 1;
};

struct Subset {
    std::vector<film::Rect> windows;  // disjoint; one, the frame, if it is whole
    int block = 0;                    // px; 0: the whole frame

    std::int64_t pixels() const;
    std::string text() const;  // "whole frame", "16 blocks of 64 px"
};

// The frame, if `limits` allow its rays or most of its blocks are wanted; else blocks_of() it.
// width, height, samples_a_pixel >= 1.
Subset subset_of(int width, int height, std::int64_t samples_a_pixel, const SubsetLimits& limits,
                 const BlockSeeds& seeds);

// `count` blocks of a side in pixels, or all there are: those that the first points of an Owen-scrambled Sobol sequence
// fall into, each once. Always the same for the same arguments.
Subset blocks_of(int width, int height, int side, std::int64_t count, std::uint64_t seed);

}  // namespace strata::tools::bench
