#include "src/film/shard.h"

#include <algorithm>
#include <cassert>

#include "src/film/tiles.h"
#include "src/sample/permutation.h"

namespace strata::film {
namespace {

// Of the streams that permutations are drawn by: any number that no other use has.
constexpr std::uint64_t kDealKey = 0x5368'6172'6473'2e31;  // "Shards.1"

Rect slot_in_grid(std::int64_t index, std::int64_t columns) {
    const auto x = static_cast<int>(index % columns * kShardBlock), y = static_cast<int>(index / columns * kShardBlock);
    return {x, y, x + kShardBlock, y + kShardBlock};
}

}  // namespace

ShardDeal::ShardDeal(const Rect& window, int count)
    : window_(window),
      count_(count),
      columns_(divide_up(window.width(), kShardBlock)),
      rows_(divide_up(window.height(), kShardBlock)) {}

Rect ShardDeal::block(std::int64_t index) const {
    const Rect slot = slot_in_grid(index, columns_);
    return {window_.x0 + slot.x0, window_.y0 + slot.y0, std::min(window_.x0 + slot.x1, window_.x1),
            std::min(window_.y0 + slot.y1, window_.y1)};
}

std::vector<int> ShardDeal::owners_of_deal(std::int64_t deal) const {
    std::vector<std::uint32_t> drawn(static_cast<std::size_t>(count_));
    sample::draw_permutation(kDealKey + static_cast<std::uint64_t>(deal), drawn);
    const std::int64_t left = blocks() - deal * count_;
    drawn.resize(static_cast<std::size_t>(std::min<std::int64_t>(count_, left)));
    std::vector<int> owners;
    owners.reserve(drawn.size());
    for (const std::uint32_t shard : drawn) owners.push_back(static_cast<int>(shard) + 1);
    return owners;
}

ShardPicture::ShardPicture(const Rect& window, const Shard& shard) : whole_(window), shard_(shard) {
    const ShardDeal deal(window, shard.count);
    assert(shard.number >= 1 && shard.number <= shard.count && shard.count <= deal.blocks());
    for (std::int64_t first = 0; first < deal.blocks(); first += shard.count) {
        const std::vector<int> owners = deal.owners_of_deal(first / shard.count);
        const auto found = std::ranges::find(owners, shard.number);
        if (found != owners.end()) blocks_.push_back(deal.block(first + (found - owners.begin())));
    }
    columns_ = divide_up(deal.columns(), shard.count);
    rows_ = divide_up(static_cast<std::int64_t>(blocks_.size()), columns_);
}

Rect ShardPicture::window() const {
    return {0, 0, static_cast<int>(columns_ * kShardBlock), static_cast<int>(rows_ * kShardBlock)};
}

Rect ShardPicture::slot(std::int64_t index) const { return slot_in_grid(index, columns_); }

Rect ShardPicture::block(std::int64_t index) const {
    return index < static_cast<std::int64_t>(blocks_.size()) ? blocks_[static_cast<std::size_t>(index)] : Rect{};
}

std::int64_t ShardPicture::pixels() const {
    std::int64_t pixels = 0;
    for (const Rect& block : blocks_) pixels += std::int64_t{1} * block.width() * block.height();
    return pixels;
}

}  // namespace strata::film
