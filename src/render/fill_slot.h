// A block of a shard put where it belongs in the part. Private to src/render.
#pragma once

#include <cstdint>

#include "src/film/film.h"
#include "src/film/shard.h"

namespace strata::render {

// Fills a slot of `film` with the block that render(block) gives as a film of its own. What no pixel of the picture
// fills is black. False if the block is not complete: it was cancelled.
template <class Render>
bool fill_slot(const film::ShardPicture& shard, std::int64_t slot, film::Film& film, const Render& render) {
    const film::Rect at = shard.slot(slot), block = shard.block(slot);
    bool is_complete = true;
    if (block.width() > 0) {
        const film::Film own = render(block);
        is_complete = own.complete();
        film.paste(own, at.x0 - block.x0, at.y0 - block.y0);
    }
    for (int y = at.y0; y < at.y1; ++y) {
        for (int x = at.x0; x < at.x1; ++x) {
            const bool is_outside = x - at.x0 >= block.width() || y - at.y0 >= block.height();
            if (!is_outside) continue;
            film.finish(x, y, glm::vec3(0));
            if (!film.weights().empty()) film.set_weight(x, y, 1);  // passes are divided by their sums
        }
    }
    return is_complete;
}

}  // namespace strata::render
