// What a render in progress shares between its workers. Private to src/render.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "src/render/render.h"
#include "src/render/task_seam.h"

namespace strata::render {

// Of one thread at a time; buffers are kept from tile to tile.
struct alignas(64) Worker {
    SampleSet samples;
    std::vector<glm::ivec2> owners;  // pixels or cells of `samples`
    std::vector<glm::vec3> radiance;
    std::vector<integrate::SampleCost> costs;  // empty unless asked for
    integrate::Counters counters;
    double cpu_seconds = 0;
};

class RenderContext {
  public:
    RenderContext(const integrate::ImageFunction& image_function, const Estimator& pixel_estimator,
                  const RenderOptions& render_options, std::int64_t total_work);

    // Calls body(worker, index) for every index of [0,count), on all threads.
    void run(std::int64_t count, const std::function<void(Worker&, std::int64_t)>& body);

    // Evaluates the worker's samples in batches; false if cancelled on the way.
    bool evaluate(Worker& worker, std::span<glm::vec3> radiance) const;

    bool cancelled() const { return options.cancel != nullptr && options.cancel->requested(); }

    // Of the samples of worker.owners[owner], which were evaluated with costs.
    glm::vec2 mean_cost(const Worker& worker, std::size_t owner) const;

    // As many owners as fill a batch, at least one.
    std::size_t owners_a_batch() const;

    int threads() const { return seam_.threads(); }

    // Sums up what the workers did.
    void finish(RenderResult& result) const;

    const integrate::ImageFunction& image;
    const Estimator& estimator;
    const RenderOptions& options;
    ProgressMeter progress;

  private:
    TaskSeam seam_;
    std::vector<Worker> workers_;
};

// Estimators whose samples belong to a pixel: tiles, cut where strips are. Sets what `result` has of pixels.
void render_tiles(RenderContext& context, const StripLayout& layout, StripSink sink, RenderResult& result);

// Estimators whose samples belong to a screen cell and count in many pixels.
void render_shared(RenderContext& context, const StripLayout& layout, StripSink sink, RenderResult& result);

// What the films of such a render hold.
FilmExtras film_extras(const RenderOptions& options, const Estimator& estimator);

// Cells whose samples can reach the window's pixels.
Window cells_of(const Window& window, const Estimator& estimator);

}  // namespace strata::render
