#include "src/render/render.h"

#include <stdexcept>

#include "src/render/render_context.h"

namespace strata::render {

Window cells_of(const Window& window, const Estimator& estimator) {
    const int reach = estimator.weights().reach();
    return {window.x0 - reach, window.y0 - reach, window.x1 + reach, window.y1 + reach};
}

RenderResult render(const ImageFunction& image, const Estimator& estimator, const Window& window,
                    const RenderOptions& options) {
    if (window.width() <= 0 || window.height() <= 0) throw std::invalid_argument("the window to render is empty");
    if (options.tile < 1) throw std::invalid_argument("a tile's side is at least 1");
    const Window owners = estimator.shared() ? cells_of(window, estimator) : window;
    RenderContext context(image, estimator, options, std::int64_t{1} * owners.width() * owners.height());
    RenderResult result;
    result.film = Film(window);
    if (estimator.shared()) {
        render_shared(context, result.film);
    } else {
        render_tiles(context, options.tile, result.film);
    }
    context.finish(result);
    return result;
}

}  // namespace strata::render
