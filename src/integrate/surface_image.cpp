#include "src/integrate/surface_image.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "src/integrate/phase_meter.h"
#include "src/integrate/surface_image_chunk.h"
#include "src/scene/needs.h"
#include "src/trace/reference_tracer.h"

namespace strata::integrate {

namespace {

// Rays traced at once: enough to keep packets full, few enough for their data to stay in the second-level cache.
constexpr std::size_t kChunk = 4096;

}  // namespace

SurfaceImage::SurfaceImage(const scene::Scene& scene, Tracer tracer, std::uint32_t step_limit)
    : scene_(scene),
      tracer_(tracer),
      step_limit_(step_limit),
      shader_(scene.material, scene.sun, scene.sky),
      field_(scene.surface),
      fast_(field_),
      placement_(scene.surface),
      path_(scene.camera),
      camera_(path_.at(0.0), scene.film),
      samples_a_side_(scene.sampling.estimator == scene::EstimatorKind::none ? 1 : scene.sampling.N),
      sun_direction_(glm::normalize(scene.sun.direction)) {
    if (tracer_ != Tracer::fast) return;
    beams_.emplace(scene_, path_, placement_, field_);
    if (!scene::needs_shadow_rays(scene_.sun)) return;
    // The sun's beams are of one instant of the surface.
    if (scene::needs_time_samples(scene_) && (placement_.moves() || field_.drifts())) return;
    const scene::TimeSpan shutter = scene::open_shutter(scene_);
    const double time = 0.5 * (shutter.first + shutter.last);
    sun_beams_.emplace(field_, trace::Placement::direction_to_local(placement_.orientation(time), sun_direction_),
                       field_.noise_shift(time));
    if (!sun_beams_->usable()) sun_beams_.reset();
}

trace::Ray SurfaceImage::camera_ray(double u, double v, double t) const {
    return camera_ray(path_.moves() ? trace::Camera(path_.at(t), scene_.film) : camera_, u, v);
}

trace::Ray SurfaceImage::camera_ray(const trace::Camera& camera, double u, double v) const {
    const trace::CameraRay seen = camera.ray(u, v);
    return {.origin = camera.position(),
            .direction = seen.direction,
            .noise_shift = {},
            .limit = scene_.camera.far,
            .delta0 = 0.0,
            .delta_slope = scene_.sampling.tolerance * seen.pixel_angle,
            .step_limit = step_limit_};
}

trace::Ray SurfaceImage::world_ray(const glm::dvec3& origin, const glm::dvec3& direction, double t) const {
    trace::Ray ray = camera_ray(0.5 * scene_.film.width, 0.5 * scene_.film.height, t);
    ray.origin = origin;
    ray.direction = glm::normalize(direction);
    return ray;
}

void SurfaceImage::trace(std::span<const trace::Ray> rays, std::span<trace::Hit> hits,
                         trace::TraceCounters& counters) const {
    if (tracer_ == Tracer::reference) return trace::trace_reference(field_, rays, hits, counters);
    fast_.trace(rays, hits, counters);
}

// On the bound the noise has no part in the normal, and is not evaluated.
void SurfaceImage::gradients(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                             std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient,
                             trace::TraceCounters& counters) const {
    if (tracer_ == Tracer::fast) return fast_.gradients(hits, x, noise_shift, gradient, counters);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (hits[i].on_bound) continue;
        gradient[i] = glm::vec3(field_.gradient(x[i], noise_shift.empty() ? glm::dvec3(0.0) : noise_shift[i]));
        counters.noise_evaluations += field_.octaves().size();
        counters.executed_lanes += field_.octaves().size();
    }
}

void SurfaceImage::normals(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                           std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> normal,
                           trace::TraceCounters& counters) const {
    gradients(hits, x, noise_shift, normal, counters);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (hits[i].on_bound) normal[i] = glm::vec3(field_.bound_normal(x[i]));
        const float length = glm::length(normal[i]);
        normal[i] = length > 0.0f ? normal[i] / length : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

void SurfaceImage::evaluate(const SampleBatch& samples, std::span<glm::vec3> radiance, Counters& counters) const {
    evaluate_with_costs(samples, radiance, {}, counters);
}

void SurfaceImage::evaluate_with_costs(const SampleBatch& samples, std::span<glm::vec3> radiance,
                                       std::span<SampleCost> costs, Counters& counters) const {
    std::fill(costs.begin(), costs.end(), SampleCost{});
    thread_local Chunk chunk;  // fresh memory for every batch would cost as much as the shading
    chunk.costs = {};
    chunk.resize_samples(0);
    chunk.reserve(std::min(kChunk, samples.u.size()), field_.drifts(), scene::needs_shadow_rays(scene_.sun));
    if (beams_) return evaluate_beamed(samples, radiance, costs, chunk, counters);
    for (std::size_t begin = 0; begin < samples.u.size(); begin += kChunk) {
        const std::size_t count = std::min(kChunk, samples.u.size() - begin);
        const SampleBatch part{samples.u.subspan(begin, count), samples.v.subspan(begin, count),
                               samples.t.subspan(begin, count)};
        if (!costs.empty()) chunk.costs = costs.subspan(begin, count);
        evaluate_chunk(part, radiance.subspan(begin, count), chunk, counters);
    }
}

// Cell by cell, with what the cells' beams found.
void SurfaceImage::evaluate_beamed(const SampleBatch& samples, std::span<glm::vec3> radiance,
                                   std::span<SampleCost> costs, Chunk& chunk, Counters& counters) const {
    PhaseMeter meter(counters);
    trace::TraceCounters traced;
    beams_->trace(samples.u, samples.v, samples.t, chunk.beamed, traced);
    meter.book(Phase::beams, traced);
    const std::span<const accel::BeamedCell> cells = chunk.beamed.cells;
    for (std::size_t begin = 0; begin < cells.size();) {
        std::size_t end = begin + 1;  // one cell may be too large for a chunk
        while (end < cells.size() && cells[end].last - cells[begin].first <= kChunk) ++end;
        meter.skip();
        traced = {};
        beams_->open_windows(chunk.beamed, cells.subspan(begin, end - begin), chunk.windows, traced);
        meter.book(Phase::windows, traced);
        evaluate_cells(samples, cells.subspan(begin, end - begin), radiance, costs, chunk, counters);
        begin = end;
    }
}

// chunk.windows are those of these cells.
void SurfaceImage::evaluate_cells(const SampleBatch& samples, std::span<const accel::BeamedCell> cells,
                                  std::span<glm::vec3> radiance, std::span<SampleCost> costs, Chunk& chunk,
                                  Counters& counters) const {
    const std::span<const std::uint32_t> order = chunk.beamed.samples.order;
    std::size_t cell = 0;
    for (std::size_t begin = cells.front().first, end; begin < cells.back().last; begin = end) {
        PhaseMeter meter(counters);
        end = std::min<std::size_t>(begin + kChunk, cells.back().last);
        chunk.resize_samples(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            while (i >= cells[cell].last) ++cell;
            const std::size_t sample = order[i], to = i - begin;
            chunk.u[to] = samples.u[sample];
            chunk.v[to] = samples.v[sample];
            chunk.t[to] = samples.t[sample];
            chunk.start[to] = cells[cell].misses ? std::numeric_limits<double>::infinity() : cells[cell].start;
            chunk.hint[to] = cells[cell].hint;
            chunk.window[to] = chunk.windows.first(cell);
        }
        chunk.radiance.resize(end - begin);
        chunk.sample_costs.assign(costs.empty() ? 0 : end - begin, {});
        chunk.costs = chunk.sample_costs;
        meter.book(Phase::shading);
        evaluate_chunk({chunk.u, chunk.v, chunk.t}, chunk.radiance, chunk, counters);
        meter.skip();
        for (std::size_t i = begin; i < end; ++i) radiance[order[i]] = chunk.radiance[i - begin];
        for (std::size_t i = 0; i < chunk.costs.size(); ++i) costs[order[begin + i]] = chunk.costs[i];
        meter.book(Phase::shading);
    }
}

}  // namespace strata::integrate
