// A picture cut into shards: parts of it that are rendered apart, by whatever machines, and put together again.
#pragma once

#include <cstdint>
#include <vector>

#include "src/film/film.h"

namespace strata::film {

// The part `number` of `count`, from 1 on.
struct Shard {
    int number = 1;
    int count = 1;
    bool operator==(const Shard&) const = default;
};

inline constexpr int kMostShards = 10'000;

// The side of the blocks that shards are made of: a tile of an EXR, and the rows that are encoded at once.
inline constexpr int kShardBlock = 64;

// The blocks of a window, row by row, go to the shards as cards are dealt: each `count` blocks that follow one another
// are given to the shards one each, in an order drawn anew for each deal. So shards have as many blocks as one another,
// or one more, of all regions of the picture, and what a region costs more or less than others falls on all of them;
// a rule without chance would give some shards the columns of a mountain and others those of the sky.
class ShardDeal {
  public:
    ShardDeal(const Rect& window, int count);

    std::int64_t blocks() const { return columns_ * rows_; }
    std::int64_t columns() const { return columns_; }
    Rect block(std::int64_t index) const;

    // The shard numbers of the blocks of a deal, the last one's fewer.
    std::vector<int> owners_of_deal(std::int64_t deal) const;

  private:
    Rect window_;
    int count_;
    std::int64_t columns_, rows_;
};

// A shard as a picture of its own: its blocks side by side in slots of kShardBlock pixels a side, in the order of the
// whole picture. Blocks at the whole's right and lower border may be smaller than their slots, and the last row of
// slots may have some without a block: what no pixel fills is black. It has about as many rows as the whole picture, so
// that both can be read and written in step.
class ShardPicture {
  public:
    // count <= the number of blocks.
    ShardPicture(const Rect& window, const Shard& shard);

    const Rect& whole() const { return whole_; }
    const Shard& shard() const { return shard_; }

    // Of the part, from (0,0).
    Rect window() const;

    std::int64_t slots() const { return columns_ * rows_; }
    std::int64_t slots_a_row() const { return columns_; }

    // Where a slot is in the part, and its block in the whole: empty for a slot without one.
    Rect slot(std::int64_t index) const;
    Rect block(std::int64_t index) const;

    // Pixels of the whole that are in this part.
    std::int64_t pixels() const;

  private:
    Rect whole_;
    Shard shard_;
    std::vector<Rect> blocks_;
    std::int64_t columns_, rows_;
};

}  // namespace strata::film
