// What a render of shared samples settles before it begins. Private to src/render.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "src/estimate/render_accumulators.h"
#include "src/film/row_keeper.h"
#include "src/film/row_stream.h"
#include "src/integrate/channels.h"

namespace strata::render {

// A channel beside colour that is weighted as colour is: it has sums of its own, so that colour without it takes no
// more work or memory.
struct SharedLayer {
    // From a block's values, of which each sample has `stride`, to those of the run from its sample `offset` on.
    void gather(std::span<const float> block, std::size_t stride, std::size_t offset) {
        for (std::size_t i = 0; i * stride < block.size(); ++i) {
            std::copy_n(block.begin() + static_cast<std::ptrdiff_t>(i * stride + entry.first), entry.count,
                        &values[offset + i].x);
        }
    }

    integrate::ChannelSet::Entry entry;  // or a part of one
    std::vector<glm::vec3> values;       // of the run's samples
    estimate::PixelAccumulators accumulators;
};

// The channels that are such layers; those of more values than a layer has are several.
inline constexpr std::size_t kLayerValues = 3;
std::vector<integrate::ChannelSet::Entry> layer_entries(const integrate::ChannelSet& channels);

// Cells that are evaluated before their samples are added up: few enough for a buffer.
std::int64_t cells_in_a_run(const film::Rect& cells, std::size_t samples_a_cell, std::size_t layers);

// Strips that hold rows of one run, finished or given away beside the next; with the rows that wait for others.
int most_open(const film::StripLayout& layout, int reach);

// Rows at the top that an earlier process finished are left out: what lies below is the same picture as a crop, to the
// last bit. Single rows further down are rendered again.
film::Rect rows_left(const film::RowKeeper* keeper, const film::Rect& window);

}  // namespace strata::render
