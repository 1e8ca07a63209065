// From an image function to a film: in parallel, and the same bits for any number of threads, tile size and window.
#pragma once

#include "src/estimate/estimator.h"
#include "src/film/film.h"
#include "src/film/row_keeper.h"
#include "src/film/row_stream.h"
#include "src/film/shard.h"
#include "src/integrate/image_function.h"
#include "src/parallel/cancel.h"
#include "src/parallel/progress.h"

namespace strata::render {

struct RenderOptions {
    int threads = 0;                                // 0: as many as the machine has
    int tile = 32;                                  // side in pixels, >= 1
    parallel::ProgressCallback on_progress;         // may be empty; called from any thread, one call at a time
    const parallel::CancelToken* cancel = nullptr;  // looked at between batches
    integrate::ChannelSet channels{};               // that films hold beside radiance
    film::RowKeeper* keeper = nullptr;  // of pixels that an earlier process finished, and of those that this one does
    const film::ShardPicture* shard = nullptr;  // render this part, whose window is the one to be rendered; null: all
    bool with_weights = false;  // films hold pixels' sums of weights, where these differ from seed to seed
};

struct RenderResult {
    film::Film film;  // empty where strips were given away
    std::int64_t finished_pixels = 0;
    std::size_t most_film_bytes = 0;  // of pixels held at once, those of `film` not counted
    integrate::Counters counters;
    int threads = 0;         // used
    double seconds = 0;      // by the clock
    double cpu_seconds = 0;  // of all threads: sampling, evaluating, filtering
    bool cancelled = false;  // some pixels are not finished
};

// Renders pixels [x0,x1) x [y0,y1) of the frame; the frame itself has no part in it, and the window may be anywhere.
// Throws std::invalid_argument for an empty window, a tile below 1, or another window than options.shard has.
RenderResult render(const integrate::ImageFunction& image, const estimate::Estimator& estimator,
                    const film::Rect& window, const RenderOptions& options = {});

// The same pixels, given away in strips of `strip_rows` >= 1 rows while the render goes on: of the picture only a few
// strips are held at any time. The sink is called from any thread and given the whole window, of a cancelled render
// too. What it throws is thrown again after the render, which goes on without calling it: to stop, request cancelling.
RenderResult render_strips(const integrate::ImageFunction& image, const estimate::Estimator& estimator,
                           const film::Rect& window, const RenderOptions& options, int strip_rows,
                           film::StripSink sink);

}  // namespace strata::render
