// Shared samples: screen cells are evaluated once each, row by row, in runs that fit a buffer. A run is evaluated in
// parallel over its cells, then added up in parallel over strips of pixel columns; each pixel sees the same order of
// additions whatever the runs and strips are.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "src/render/fill_slot.h"
#include "src/render/render_context.h"
#include "src/render/shared_plan.h"

namespace strata::render {

namespace {

constexpr int kStripColumns = 64;

class SharedRender {
  public:
    SharedRender(RenderContext& context, const film::StripLayout& layout, film::StripSink sink,
                 film::RowKeeper* keeper);

    void render();

    const film::RowStream& film() const { return film_; }

  private:
    struct Run {
        std::int64_t first, last;  // cells, row by row
    };

    glm::ivec2 cell(std::int64_t index) const;
    estimate::CellSamples samples_of(std::int64_t index, const Run& run, std::span<const glm::vec3> values) const;
    int accumulator_rows() const;
    void evaluate(const Run& run);
    void filter_own_channels(const Worker& worker);
    void give_away(Worker& worker, int strips_end);
    void evaluate_block(Worker& worker, std::int64_t first, std::int64_t last, const Run& run);
    void add_up(const Run& run);
    void add_to_strip(const Run& run, int x0, int x1);
    void finish_rows(int rows_end, int x0, int x1);
    void order_ranks(const film::Rect& part, film::Film& film) const;
    void note_rows(int rows_end);
    template <class Action>
    void for_each_strip(int rows_end, const Action& action);
    int finished_rows_end(const Run& run) const;

    RenderContext& context_;
    film::RowStream film_;
    film::Rect window_;  // of the rows that are left to be rendered
    film::Rect cells_;
    int reach_;
    std::size_t samples_a_cell_;
    std::int64_t cells_a_run_;
    std::vector<float> fraction_u_, fraction_v_;  // of the run's samples
    std::vector<glm::vec3> radiance_;
    estimate::PixelAccumulators accumulators_;
    std::vector<SharedLayer> layers_;
    int finished_end_;   // pixel rows above are in the film
    int given_end_ = 0;  // strips above are given away
};

SharedRender::SharedRender(RenderContext& context, const film::StripLayout& layout, film::StripSink sink,
                           film::RowKeeper* keeper)
    : context_(context),
      film_(layout, std::vector<int>(static_cast<std::size_t>(layout.count()), 1),
            most_open(layout, context.estimator.weights().reach()), film_extras(context.options, context.estimator),
            std::move(sink), keeper),
      window_(rows_left(keeper, layout.window)),
      cells_(window_.height() == 0 ? window_ : cells_of(window_, context.estimator)),
      reach_(context.estimator.weights().reach()),
      samples_a_cell_(static_cast<std::size_t>(context.estimator.sample_count())),
      cells_a_run_(cells_in_a_run(cells_, samples_a_cell_, layer_entries(context.options.channels).size())),
      fraction_u_(static_cast<std::size_t>(cells_a_run_) * samples_a_cell_),
      fraction_v_(fraction_u_.size()),
      radiance_(fraction_u_.size()),
      accumulators_(window_, context.estimator.weights(), accumulator_rows()),
      finished_end_(window_.y0) {
    for (const integrate::ChannelSet::Entry& entry : layer_entries(context.options.channels)) {
        layers_.push_back({entry,
                           std::vector<glm::vec3>(radiance_.size(), glm::vec3(0.0f)),
                           {window_, context.estimator.weights(), accumulator_rows()}});
    }
}

// Rows seen by a run's cells, which may begin and end within a row, and rows that an earlier run left unfinished.
int SharedRender::accumulator_rows() const {
    const std::int64_t rows = cells_a_run_ / cells_.width() + 2 + 2 * reach_ + 1;
    return static_cast<int>(std::min<std::int64_t>(rows, window_.height()));
}

glm::ivec2 SharedRender::cell(std::int64_t index) const {
    return {cells_.x0 + static_cast<int>(index % cells_.width()), cells_.y0 + static_cast<int>(index / cells_.width())};
}

// values: radiance, or a channel of the same samples.
estimate::CellSamples SharedRender::samples_of(std::int64_t index, const Run& run,
                                               std::span<const glm::vec3> values) const {
    const std::size_t first = static_cast<std::size_t>(index - run.first) * samples_a_cell_;
    return {cell(index), std::span(fraction_u_).subspan(first, samples_a_cell_),
            std::span(fraction_v_).subspan(first, samples_a_cell_), values.subspan(first, samples_a_cell_)};
}

void SharedRender::render() {
    const std::int64_t total = std::int64_t{1} * cells_.width() * cells_.height();
    const film::Rect all = cells_of(film_.layout().window, context_.estimator);
    context_.progress.leave_out(std::int64_t{1} * all.width() * all.height() - total);
    for (std::int64_t first = 0; first < total && !context_.cancelled(); first += cells_a_run_) {
        const Run run{first, std::min(first + cells_a_run_, total)};
        evaluate(run);
        if (context_.cancelled()) break;
        add_up(run);
    }
    context_.run(1, [&](Worker& worker, std::int64_t) { give_away(worker, film_.layout().count()); });
}

void SharedRender::give_away(Worker& worker, int strips_end) {
    for (; given_end_ < strips_end; ++given_end_) worker.cpu_seconds -= film_.end_part(given_end_);
    worker.cpu_seconds -= film_.keep_if_due();
}

void SharedRender::evaluate(const Run& run) {
    const auto block = static_cast<std::int64_t>(context_.owners_a_batch());
    const film::StripLayout& layout = film_.layout();
    const int whole_strips = finished_end_ == window_.y1 ? layout.count() : layout.strip_at(finished_end_);
    // One thread gives away what the run before has finished.
    context_.run(1 + (run.last - run.first + block - 1) / block, [&](Worker& worker, std::int64_t index) {
        if (index == 0) return give_away(worker, whole_strips);
        const std::int64_t first = run.first + (index - 1) * block;
        evaluate_block(worker, first, std::min(first + block, run.last), run);
    });
}

void SharedRender::evaluate_block(Worker& worker, std::int64_t first, std::int64_t last, const Run& run) {
    worker.owners.clear();
    for (std::int64_t index = first; index < last; ++index) worker.owners.push_back(cell(index));
    context_.estimator.cell_samples(worker.owners, worker.samples);
    const std::size_t offset = static_cast<std::size_t>(first - run.first) * samples_a_cell_;
    const std::size_t count = worker.samples.u.size();
    if (!context_.evaluate(worker, std::span(radiance_).subspan(offset, count))) return;
    std::copy_n(worker.samples.fraction_u.begin(), count, fraction_u_.begin() + static_cast<std::ptrdiff_t>(offset));
    std::copy_n(worker.samples.fraction_v.begin(), count, fraction_v_.begin() + static_cast<std::ptrdiff_t>(offset));
    if (!context_.options.channels.empty()) filter_own_channels(worker);
    for (SharedLayer& layer : layers_) layer.gather(worker.channels, context_.options.channels.values(), offset);
    context_.progress.add(last - first, static_cast<std::int64_t>(count));
}

// A cell is a pixel's square: its samples are those taken for that pixel.
void SharedRender::filter_own_channels(const Worker& worker) {
    for (std::size_t i = 0; i < worker.owners.size(); ++i) {
        const auto& [x, y] = std::pair(worker.owners[i].x, worker.owners[i].y);
        if (x < window_.x0 || x >= window_.x1 || y < window_.y0 || y >= window_.y1) continue;
        film::Film& film = film_.open(film_.layout().strip_at(y));
        estimate::filter_own(context_.options.channels, context_.samples_of(worker, i), film.channels_at(x, y));
    }
}

// Below the returned row, pixels still wait for cells after the run.
int SharedRender::finished_rows_end(const Run& run) const {
    const int complete_cell_rows = static_cast<int>(run.last / cells_.width());
    return std::clamp(cells_.y0 + complete_cell_rows - reach_, finished_end_, window_.y1);
}

void SharedRender::add_up(const Run& run) {
    const int strips = (window_.width() + kStripColumns - 1) / kStripColumns;
    const int finished_end = finished_rows_end(run);
    context_.run(strips, [&](Worker&, std::int64_t strip) {
        const int x0 = window_.x0 + static_cast<int>(strip) * kStripColumns;
        const int x1 = std::min(x0 + kStripColumns, window_.x1);
        add_to_strip(run, x0, x1);
        if (!context_.cancelled()) finish_rows(finished_end, x0, x1);
    });
    if (!context_.cancelled()) note_rows(finished_end);
    finished_end_ = finished_end;
}

// Of the rows from finished_end_ on: action(strip, first row, last row).
template <class Action>
void SharedRender::for_each_strip(int rows_end, const Action& action) {
    for (int y = finished_end_; y < rows_end;) {
        const int strip = film_.layout().strip_at(y);
        const int end = std::min(rows_end, film_.layout().strip(strip).y1);
        action(strip, y, end);
        y = end;
    }
}

void SharedRender::finish_rows(int rows_end, int x0, int x1) {
    for_each_strip(rows_end, [&](int strip, int begin, int end) {
        film::Film& film = film_.open(strip);
        for (SharedLayer& layer : layers_) {
            layer.accumulators.finish_channel(begin, end, x0, x1, layer.entry.first, layer.entry.count, film);
        }
        if (context_.options.channels.has(integrate::ChannelFilter::ranks)) order_ranks({x0, begin, x1, end}, film);
        accumulators_.finish(begin, end, x0, x1, film);
    });
}

void SharedRender::order_ranks(const film::Rect& part, film::Film& film) const {
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            estimate::order_ranks(context_.options.channels, film.channels_at(x, y));
}

void SharedRender::note_rows(int rows_end) {
    for_each_strip(rows_end, [&](int strip, int begin, int end) {
        film_.note_finished(strip, {window_.x0, begin, window_.x1, end});
    });
}

void SharedRender::add_to_strip(const Run& run, int x0, int x1) {
    const std::int64_t width = cells_.width();
    for (std::int64_t row = run.first / width; row * width < run.last; ++row) {
        const std::int64_t row_start = row * width - cells_.x0;
        const std::int64_t first = std::max(run.first, row_start + x0 - reach_);
        const std::int64_t last = std::min(run.last, row_start + x1 + reach_);
        for (std::int64_t index = first; index < last; ++index) {
            if (context_.cancelled()) return;
            accumulators_.add(samples_of(index, run, radiance_), x0, x1);
            for (SharedLayer& layer : layers_) layer.accumulators.add(samples_of(index, run, layer.values), x0, x1);
        }
    }
}

}  // namespace

namespace {

film::Film render_block(RenderContext& context, const film::Rect& block) {
    film::Film film(block, film_extras(context.options, context.estimator));
    SharedRender shared(
        context, {block, film::kShardBlock}, [&](const film::Film& strip) { film.paste(strip); }, nullptr);
    shared.render();
    shared.film().check();
    return film;
}

// Blocks of a shard are pictures of their own, one after the other: cells around each are evaluated for it alone.
void render_shared_shard(RenderContext& context, const film::StripLayout& layout, film::StripSink sink,
                         RenderResult& result) {
    const film::ShardPicture& shard = *context.options.shard;
    const auto slots_a_row = static_cast<int>(shard.slots_a_row());
    film::RowStream film(layout, std::vector<int>(static_cast<std::size_t>(layout.count()), slots_a_row), 1,
                         film_extras(context.options, context.estimator), std::move(sink), context.options.keeper);
    for (std::int64_t i = 0; i < shard.slots(); ++i) {
        const auto strip = static_cast<int>(i / slots_a_row);
        const film::Rect slot = shard.slot(i);
        const auto render = [&](const film::Rect& block) { return render_block(context, block); };
        if (!context.is_kept(slot) && !context.cancelled() && fill_slot(shard, i, film.open(strip), render)) {
            film.note_finished(strip, slot);
        }
        film.end_part(strip);
    }
    film.check();
    result.finished_pixels = film.finished_pixels();
    result.most_film_bytes = film.most_bytes();
}

}  // namespace

void render_shared(RenderContext& context, const film::StripLayout& layout, film::StripSink sink,
                   RenderResult& result) {
    if (context.options.shard != nullptr) return render_shared_shard(context, layout, std::move(sink), result);
    SharedRender shared(context, layout, std::move(sink), context.options.keeper);
    shared.render();
    shared.film().check();
    result.finished_pixels = shared.film().finished_pixels();
    result.most_film_bytes = shared.film().most_bytes();
}

}  // namespace strata::render
