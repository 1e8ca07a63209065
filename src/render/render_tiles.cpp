#include <cstddef>

#include "src/render/render_context.h"
#include "src/render/tiles.h"

namespace strata::render {

namespace {

// Equation (3), or (2) where there are weights; summed in the samples' order, in double.
glm::vec3 weighted_mean(std::span<const glm::vec3> radiance, std::span<const double> weight) {
    glm::dvec3 sum(0.0);
    double total = 0;
    if (weight.empty()) {
        for (const glm::vec3& sample : radiance) sum += glm::dvec3(sample);
        total = static_cast<double>(radiance.size());
    } else {
        for (std::size_t i = 0; i < radiance.size(); ++i) {
            sum += weight[i] * glm::dvec3(radiance[i]);
            total += weight[i];
        }
    }
    return glm::vec3(sum / total);
}

// The pixels of worker.owners; false if cancelled.
bool render_pixels(RenderContext& context, Worker& worker, Film& film) {
    context.estimator.pixel_samples(worker.owners, worker.samples);
    worker.radiance.resize(worker.samples.u.size());
    if (!context.evaluate(worker, worker.radiance)) return false;
    const std::size_t n = static_cast<std::size_t>(context.estimator.sample_count());
    const std::span<const glm::vec3> radiance(worker.radiance);
    const std::span<const double> weight(worker.samples.weight);
    for (std::size_t p = 0; p < worker.owners.size(); ++p) {
        const std::span<const double> pixel_weight = weight.empty() ? weight : weight.subspan(p * n, n);
        film.finish(worker.owners[p].x, worker.owners[p].y, weighted_mean(radiance.subspan(p * n, n), pixel_weight));
    }
    const auto pixels = static_cast<std::int64_t>(worker.owners.size());
    context.progress.add(pixels, pixels * context.estimator.sample_count());
    worker.owners.clear();
    return true;
}

void render_tile(RenderContext& context, Worker& worker, const Window& tile, Film& film) {
    const std::size_t batch = context.owners_a_batch();
    worker.owners.clear();
    for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
            worker.owners.emplace_back(x, y);
            if (worker.owners.size() == batch && !render_pixels(context, worker, film)) return;
        }
    }
    if (!worker.owners.empty()) render_pixels(context, worker, film);
}

}  // namespace

void render_tiles(RenderContext& context, int side, Film& film) {
    const TileGrid tiles(film.window(), side);
    context.run(tiles.count(), [&](Worker& worker, std::int64_t position) {
        if (context.cancelled()) return;
        const Window tile = tiles.tile(spread_first(position, tiles.count()));
        render_tile(context, worker, tile, film);
    });
}

}  // namespace strata::render
