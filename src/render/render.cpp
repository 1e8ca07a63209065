#include "src/render/render.h"

#include <stdexcept>
#include <utility>

#include "src/render/render_context.h"

namespace strata::render {

void check_renderable(const film::Rect& window, const RenderOptions& options) {
    if (window.width() <= 0 || window.height() <= 0) throw std::invalid_argument("the window to render is empty");
    if (options.tile < 1) throw std::invalid_argument("a tile's side is at least 1");
    if (options.shard != nullptr && options.shard->window() != window) {
        throw std::invalid_argument("the window to render is not that of the shard");
    }
}

namespace {

// Pixels, or cells where samples are shared.
std::int64_t owners_of(const film::Rect& window, const estimate::Estimator& estimator) {
    const film::Rect owners = estimator.shared() ? cells_of(window, estimator) : window;
    return std::int64_t{1} * owners.width() * owners.height();
}

std::int64_t total_owners(const film::Rect& window, const estimate::Estimator& estimator,
                          const RenderOptions& options) {
    if (options.shard == nullptr) return owners_of(window, estimator);
    std::int64_t total = 0;
    for (std::int64_t i = 0; i < options.shard->slots(); ++i) {
        const film::Rect block = options.shard->block(i);
        if (block.width() > 0) total += owners_of(block, estimator);
    }
    return total;
}

}  // namespace

film::FilmExtras film_extras(const RenderOptions& options, const estimate::Estimator& estimator) {
    return {.channel_values = options.channels.values(),
            .weights = options.with_weights && estimator.has_random_weights()};
}

film::Rect cells_of(const film::Rect& window, const estimate::Estimator& estimator) {
    const int reach = estimator.weights().reach();
    return {window.x0 - reach, window.y0 - reach, window.x1 + reach, window.y1 + reach};
}

RenderResult render(const integrate::ImageFunction& image, const estimate::Estimator& estimator,
                    const film::Rect& window, const RenderOptions& options) {
    film::Film film;
    RenderResult result =
        render_strips(image, estimator, window, options, kWholeFilmStrip, [&](const film::Film& strip) {
            if (film.pixels().empty()) film = film::Film(window, film_extras(options, estimator));
            film.paste(strip);
        });
    result.film = std::move(film);
    return result;
}

RenderResult render_strips(const integrate::ImageFunction& image, const estimate::Estimator& estimator,
                           const film::Rect& window, const RenderOptions& options, int strip_rows,
                           film::StripSink sink) {
    check_renderable(window, options);
    if (strip_rows < 1) throw std::invalid_argument("a strip has at least one row");
    RenderContext context(image, estimator, options, total_owners(window, estimator, options));
    const film::StripLayout layout{window, strip_rows};
    RenderResult result;
    if (estimator.shared()) {
        render_shared(context, layout, std::move(sink), result);
    } else {
        render_tiles(context, layout, std::move(sink), result);
    }
    context.finish(result);
    result.cancelled = result.finished_pixels < std::int64_t{1} * window.width() * window.height();
    return result;
}

}  // namespace strata::render
