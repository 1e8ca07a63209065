#include "src/render/shared_plan.h"

namespace strata::render {

namespace {

constexpr std::size_t kRunBytes = 8u << 20;  // of samples in the buffer
constexpr std::int64_t kRunRows = 48;        // bounds the rows of pixels in work

}  // namespace

std::int64_t cells_in_a_run(const film::Rect& cells, std::size_t samples_a_cell, std::size_t layers) {
    const std::size_t bytes = samples_a_cell * (2 * sizeof(float) + (1 + layers) * sizeof(glm::vec3));
    const std::int64_t total = std::int64_t{1} * cells.width() * cells.height();
    const std::int64_t fitting = static_cast<std::int64_t>(std::max<std::size_t>(1, kRunBytes / bytes));
    return std::min({fitting, kRunRows * cells.width(), total});
}

std::vector<integrate::ChannelSet::Entry> layer_entries(const integrate::ChannelSet& channels) {
    using enum integrate::ChannelFilter;
    std::vector<integrate::ChannelSet::Entry> entries;
    for (const integrate::ChannelSet::Entry& entry : channels.entries()) {
        if (entry.channel->filter != picture && entry.channel->filter != ranks) continue;
        for (std::size_t i = 0; i < entry.sampled; i += kLayerValues) {
            const std::size_t count = std::min(kLayerValues, entry.sampled - i);
            entries.push_back({entry.channel, entry.first + i, count, count});
        }
    }
    return entries;
}

int most_open(const film::StripLayout& layout, int reach) {
    return 2 * ((static_cast<int>(kRunRows) + 2 * reach) / layout.rows + 2);
}

film::Rect rows_left(const film::RowKeeper* keeper, const film::Rect& window) {
    film::Rect left = window;
    if (keeper == nullptr) return left;
    while (left.y0 < left.y1 && keeper->has({left.x0, left.y0, left.x1, left.y0 + 1})) ++left.y0;
    return left;
}

}  // namespace strata::render
