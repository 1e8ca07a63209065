// What a render in progress shares between its workers. Private to src/render.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "src/estimate/pixel_channels.h"
#include "src/parallel/thread_pool.h"
#include "src/render/render.h"

namespace strata::render {

// Of one thread at a time; buffers are kept from tile to tile.
struct alignas(64) Worker {
    estimate::SampleSet samples;
    std::vector<glm::ivec2> owners;  // pixels or cells of `samples`
    std::vector<glm::vec3> radiance;
    std::vector<float> channels;  // of the samples: RenderOptions::channels.values() each
    integrate::Counters counters;
    double cpu_seconds = 0;
};

class RenderContext {
  public:
    RenderContext(const integrate::ImageFunction& image_function, const estimate::Estimator& pixel_estimator,
                  const RenderOptions& render_options, std::int64_t total_work);

    // Calls body(worker, index) for every index of [0,count), on all threads.
    void run(std::int64_t count, const std::function<void(Worker&, std::int64_t)>& body);

    // Evaluates the worker's samples in batches; false if cancelled on the way.
    bool evaluate(Worker& worker, std::span<glm::vec3> radiance) const;

    bool cancelled() const { return options.cancel != nullptr && options.cancel->requested(); }

    // The samples of worker.owners[owner], for its channels.
    estimate::PixelSamples samples_of(const Worker& worker, std::size_t owner) const;

    // Whether these pixels of one strip need not be rendered.
    bool is_kept(const film::Rect& part) const { return options.keeper != nullptr && options.keeper->has(part); }

    // As many owners as fill a batch, at least one.
    std::size_t owners_a_batch() const;

    int threads() const { return pool_.threads(); }

    // Sums up what the workers did.
    void finish(RenderResult& result) const;

    const integrate::ImageFunction& image;
    const estimate::Estimator& estimator;
    const RenderOptions& options;
    parallel::ProgressMeter progress;

  private:
    parallel::ThreadPool pool_;
    std::vector<Worker> workers_;
};

// Estimators whose samples belong to a pixel: tiles, cut where strips are. Sets what `result` has of pixels.
void render_tiles(RenderContext& context, const film::StripLayout& layout, film::StripSink sink, RenderResult& result);

// Estimators whose samples belong to a screen cell and count in many pixels.
void render_shared(RenderContext& context, const film::StripLayout& layout, film::StripSink sink, RenderResult& result);

// Rows of the strips of a picture that is held whole.
inline constexpr int kWholeFilmStrip = 64;

// As render() refuses.
void check_renderable(const film::Rect& window, const RenderOptions& options);

// What the films of such a render hold.
film::FilmExtras film_extras(const RenderOptions& options, const estimate::Estimator& estimator);

// Cells whose samples can reach the window's pixels.
film::Rect cells_of(const film::Rect& window, const estimate::Estimator& estimator);

}  // namespace strata::render
