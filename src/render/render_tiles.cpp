#include <algorithm>
#include <cstddef>
#include <utility>

#include "src/film/tiles.h"
#include "src/render/fill_slot.h"
#include "src/render/render_context.h"

namespace strata::render {

namespace {

struct WeightedMean {
    glm::vec3 mean;
    double weight = 0;  // the sum of weights that it was divided by
};

// Equation (3), or (2) where there are weights; summed in the samples' order, in double.
WeightedMean weighted_mean(std::span<const glm::vec3> radiance, std::span<const double> weight) {
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
    return {glm::vec3(sum / total), total};
}

// The pixels of worker.owners; false if cancelled.
bool render_pixels(RenderContext& context, Worker& worker, film::Film& film) {
    context.estimator.pixel_samples(worker.owners, worker.samples);
    worker.radiance.resize(worker.samples.u.size());
    if (!context.evaluate(worker, worker.radiance)) return false;
    const std::size_t n = static_cast<std::size_t>(context.estimator.sample_count());
    const std::span<const glm::vec3> radiance(worker.radiance);
    const std::span<const double> weight(worker.samples.weight);
    for (std::size_t p = 0; p < worker.owners.size(); ++p) {
        const std::span<const double> pixel_weight = weight.empty() ? weight : weight.subspan(p * n, n);
        const auto [x, y] = std::pair(worker.owners[p].x, worker.owners[p].y);
        const WeightedMean pixel = weighted_mean(radiance.subspan(p * n, n), pixel_weight);
        film.finish(x, y, pixel.mean);
        if (!film.weights().empty()) film.set_weight(x, y, pixel.weight);
        if (context.options.channels.empty()) continue;
        const estimate::PixelSamples samples = context.samples_of(worker, p);
        estimate::filter_own(context.options.channels, samples, film.channels_at(x, y));
        estimate::filter_weighted(context.options.channels, samples, film.channels_at(x, y));
    }
    const auto pixels = static_cast<std::int64_t>(worker.owners.size());
    context.progress.add(pixels, pixels * context.estimator.sample_count());
    worker.owners.clear();
    return true;
}

// False if cancelled.
bool render_tile(RenderContext& context, Worker& worker, const film::Rect& tile, film::Film& film) {
    const std::size_t batch = context.owners_a_batch();
    worker.owners.clear();
    for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
            worker.owners.emplace_back(x, y);
            if (worker.owners.size() == batch && !render_pixels(context, worker, film)) return false;
        }
    }
    return worker.owners.empty() || render_pixels(context, worker, film);
}

// Pixels of the tiles that are rendered ahead of their strip, 16 bytes of memory each.
constexpr std::int64_t kPixelsAhead = 1 << 16;

// Strips in work: enough that no thread waits while one strip is given away and a slow tile holds up the next.
int most_open(int threads, std::int64_t tiles_a_strip) {
    constexpr int kLeast = 3, kTilesAThread = 4;
    const std::int64_t strips = 2 + kTilesAThread * threads / tiles_a_strip;
    return static_cast<int>(std::max<std::int64_t>(kLeast, strips));
}

// What a strip is rendered in: tiles of the picture, or the slots of a shard, whose pixels are elsewhere in the
// picture.
class StripParts {
  public:
    StripParts(const film::StripLayout& layout, const RenderOptions& options)
        : layout_(layout), tile_(options.tile), shard_(options.shard) {}

    std::int64_t count(int strip) const { return shard_ != nullptr ? shard_->slots_a_row() : tiles(strip).count(); }
    film::Rect part(int strip, std::int64_t index) const {
        return shard_ != nullptr ? shard_->slot(slot(strip, index)) : tiles(strip).tile(index);
    }

    // False if cancelled. `film` holds the part.
    bool render(RenderContext& context, Worker& worker, int strip, std::int64_t index, film::Film& film) const;

  private:
    film::TileGrid tiles(int strip) const { return film::TileGrid(layout_.strip(strip), tile_); }
    std::int64_t slot(int strip, std::int64_t index) const { return strip * shard_->slots_a_row() + index; }

    const film::StripLayout& layout_;
    int tile_;
    const film::ShardPicture* shard_;
};

bool StripParts::render(RenderContext& context, Worker& worker, int strip, std::int64_t index, film::Film& film) const {
    if (shard_ == nullptr) return render_tile(context, worker, part(strip, index), film);
    return fill_slot(*shard_, slot(strip, index), film, [&](const film::Rect& block) {
        film::Film own(block, film_extras(context.options, context.estimator));
        render_tile(context, worker, block, own);
        return own;
    });
}

// The tiles of all strips, one strip's after the other's.
class TiledStrips {
  public:
    TiledStrips(RenderContext& context, const film::StripLayout& layout, film::StripSink sink)
        : context_(context),
          strip_parts_(layout, context.options),
          tiles_a_strip_(strip_parts_.count(0)),
          total_(tiles_a_strip_ * (layout.count() - 1) + strip_parts_.count(layout.count() - 1)),
          film_(layout, parts(layout), most_open(context.threads(), tiles_a_strip_),
                film_extras(context.options, context.estimator), std::move(sink), context.options.keeper) {
        const film::Rect first = strip_parts_.part(0, 0);
        most_ahead_ = std::clamp<std::int64_t>(kPixelsAhead / (std::int64_t{1} * first.width() * first.height()), 1,
                                               film::kSpreadTiles);
    }

    void render();

    const film::RowStream& film() const { return film_; }

  private:
    std::vector<int> parts(const film::StripLayout& layout) const;
    void leave_out_kept();
    void render_in_order(Worker& worker, int strip, std::int64_t index);
    void render_ahead(Worker& worker, int strip, std::int64_t index);

    RenderContext& context_;
    StripParts strip_parts_;
    std::int64_t tiles_a_strip_;  // but in the last strip, which may be lower
    std::int64_t total_;
    std::int64_t most_ahead_ = 1;
    film::RowStream film_;
};

std::vector<int> TiledStrips::parts(const film::StripLayout& layout) const {
    std::vector<int> parts;
    parts.reserve(static_cast<std::size_t>(layout.count()));
    for (int strip = 0; strip < layout.count(); ++strip) {
        parts.push_back(static_cast<int>(strip_parts_.count(strip)));
    }
    return parts;
}

// Ends a part of a strip whatever happens to it: others wait for it.
class PartScope {
  public:
    PartScope(film::RowStream& film, int strip, Worker& worker) : film_(film), strip_(strip), worker_(worker) {}
    ~PartScope() { worker_.cpu_seconds -= film_.end_part(strip_); }
    PartScope(const PartScope&) = delete;
    PartScope& operator=(const PartScope&) = delete;

  private:
    film::RowStream& film_;
    int strip_;
    Worker& worker_;
};

void TiledStrips::render_in_order(Worker& worker, int strip, std::int64_t index) {
    const PartScope part(film_, strip, worker);
    const film::Rect tile = strip_parts_.part(strip, index);
    if (context_.is_kept(tile) || context_.cancelled()) return;
    if (strip_parts_.render(context_, worker, strip, index, film_.open(strip))) film_.note_finished(strip, tile);
}

void TiledStrips::render_ahead(Worker& worker, int strip, std::int64_t index) {
    const PartScope part(film_, strip, worker);
    const film::Rect tile = strip_parts_.part(strip, index);
    if (context_.is_kept(tile) || context_.cancelled()) return;
    film::Film film(tile, film_extras(context_.options, context_.estimator));
    strip_parts_.render(context_, worker, strip, index, film);
    film_.set_aside(strip, std::move(film));
}

// So that the time that is predicted is that of what is left to be done.
void TiledStrips::leave_out_kept() {
    if (context_.options.keeper == nullptr) return;
    for (int strip = 0; strip < film_.layout().count(); ++strip) {
        for (std::int64_t i = 0; i < strip_parts_.count(strip); ++i) {
            const film::Rect tile = strip_parts_.part(strip, i);
            if (context_.is_kept(tile)) context_.progress.leave_out(std::int64_t{1} * tile.width() * tile.height());
        }
    }
}

void TiledStrips::render() {
    leave_out_kept();
    const std::int64_t ahead = film::spread_count(total_, most_ahead_);
    context_.run(total_, [&](Worker& worker, std::int64_t position) {
        const std::int64_t index = film::spread_first(position, total_, most_ahead_);
        const int strip = static_cast<int>(index / tiles_a_strip_);
        if (position < ahead) {
            render_ahead(worker, strip, index % tiles_a_strip_);
        } else {
            render_in_order(worker, strip, index % tiles_a_strip_);
        }
    });
}

}  // namespace

void render_tiles(RenderContext& context, const film::StripLayout& layout, film::StripSink sink, RenderResult& result) {
    TiledStrips strips(context, layout, std::move(sink));
    strips.render();
    strips.film().check();
    result.finished_pixels = strips.film().finished_pixels();
    result.most_film_bytes = strips.film().most_bytes();
}

}  // namespace strata::render
