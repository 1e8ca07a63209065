#include "src/render/render_context.h"

#include <algorithm>

#include "src/parallel/cpu_clock.h"

namespace strata::render {

RenderContext::RenderContext(const integrate::ImageFunction& image_function, const estimate::Estimator& pixel_estimator,
                             const RenderOptions& render_options, std::int64_t total_work)
    : image(image_function),
      estimator(pixel_estimator),
      options(render_options),
      progress(total_work, render_options.on_progress),
      pool_(render_options.threads),
      workers_(static_cast<std::size_t>(pool_.threads())) {}

void RenderContext::run(std::int64_t count, const std::function<void(Worker&, std::int64_t)>& body) {
    pool_.run(count, [&](int worker_number, std::int64_t index) {
        Worker& worker = workers_[static_cast<std::size_t>(worker_number)];
        const double start_s = parallel::thread_cpu_seconds();
        body(worker, index);
        worker.cpu_seconds += parallel::thread_cpu_seconds() - start_s;
    });
}

bool RenderContext::evaluate(Worker& worker, std::span<glm::vec3> radiance) const {
    const std::size_t count = worker.samples.u.size(), batch = image.batch_samples();
    const std::size_t values = options.channels.values();
    worker.channels.resize(count * values);
    for (std::size_t first = 0; first < count; first += batch) {
        if (cancelled()) return false;
        const std::size_t size = std::min(batch, count - first);
        const integrate::SampleBatch part = worker.samples.batch(first, size);
        const std::span<float> channels = std::span(worker.channels).subspan(first * values, size * values);
        image.evaluate(part, {radiance.subspan(first, size), options.channels, channels}, worker.counters);
        worker.counters.rays += size;
    }
    return true;
}

estimate::PixelSamples RenderContext::samples_of(const Worker& worker, std::size_t owner) const {
    const std::size_t n = static_cast<std::size_t>(estimator.sample_count()), values = options.channels.values();
    const estimate::SampleSet& samples = worker.samples;
    const std::span<const double> weight(samples.weight);
    return {worker.owners[owner], std::span(samples.u).subspan(owner * n, n),
            std::span(samples.v).subspan(owner * n, n), weight.empty() ? weight : weight.subspan(owner * n, n),
            std::span(worker.channels).subspan(owner * n * values, n * values)};
}

std::size_t RenderContext::owners_a_batch() const {
    return std::max<std::size_t>(1, image.batch_samples() / static_cast<std::size_t>(estimator.sample_count()));
}

void RenderContext::finish(RenderResult& result) const {
    for (const Worker& worker : workers_) {
        result.counters += worker.counters;
        result.cpu_seconds += worker.cpu_seconds;
    }
    result.threads = pool_.threads();
    result.seconds = progress.seconds();
}

}  // namespace strata::render
