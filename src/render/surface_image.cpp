#include "src/render/surface_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "shaders_cpu/sky.h"
#include "shaders_cpu/terrain_material.h"
#include "src/render/phase_meter.h"
#include "src/render/surface_image_chunk.h"
#include "src/scene/needs.h"
#include "src/trace/reference_tracer.h"
#include "src/trace/shadow_ray.h"

namespace strata::render {

namespace {

// Rays traced at once: enough to keep packets full, few enough for their data to stay in the second-level cache.
constexpr std::size_t kChunk = 4096;

}  // namespace

SurfaceImage::SurfaceImage(const scene::Scene& scene, Tracer tracer, std::uint32_t step_limit)
    : scene_(scene),
      tracer_(tracer),
      step_limit_(step_limit),
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
    beams_->trace(samples, chunk.beamed, traced);
    meter.book(Phase::beams, traced);
    const std::span<const BeamedCell> cells = chunk.beamed.cells;
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
void SurfaceImage::evaluate_cells(const SampleBatch& samples, std::span<const BeamedCell> cells,
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

void SurfaceImage::evaluate_chunk(const SampleBatch& samples, std::span<glm::vec3> radiance, Chunk& chunk,
                                  Counters& counters) const {
    const std::size_t count = samples.u.size();
    PhaseMeter meter(counters);

    // Rays of the camera at their own time, turned into the surface's coordinates at that time. The sky does not spin
    // with it.
    chunk.rays.resize(count);
    chunk.view.resize(count);
    chunk.sun.resize(count);
    glm::dmat3 orientation = placement_.orientation(0.0);
    glm::dvec3 sun = trace::Placement::direction_to_local(orientation, sun_direction_);
    std::optional<trace::Camera> moved;
    trace::Ray first;  // of its time
    for (std::size_t i = 0; i < count; ++i) {
        const double t = samples.t[i];
        const bool is_new_time = i == 0 || t != samples.t[i - 1];  // of an instant there is one
        if (placement_.moves() && is_new_time) {
            orientation = placement_.orientation(t);
            sun = trace::Placement::direction_to_local(orientation, sun_direction_);
        }
        if (path_.moves() && is_new_time) moved.emplace(path_.at(t), scene_.film);
        const trace::Camera& camera = moved ? *moved : camera_;
        if (is_new_time) first = to_local(orientation, camera_ray(camera, samples.u[i], samples.v[i]), t);
        const trace::CameraRay seen = camera.ray(samples.u[i], samples.v[i]);
        chunk.rays[i] = trace::Placement::from_same_point(orientation, first, seen.direction,
                                                          scene_.sampling.tolerance * seen.pixel_angle);
        if (!chunk.start.empty()) {
            chunk.rays[i].start = chunk.start[i];
            chunk.rays[i].hint = chunk.hint[i];
            chunk.rays[i].window = chunk.window[i];
        }
        chunk.view[i] = trace::Placement::direction_to_local(placement_.resting_orientation(), seen.direction);
        chunk.sun[i] = sun;
    }
    chunk.hits.resize(count);
    meter.book(Phase::shading);
    trace::TraceCounters traced;
    trace(chunk.rays, chunk.hits, traced);
    meter.book(Phase::rays, traced);

    // Positions and normals of what was hit; the rest is sky.
    chunk.lit.clear();
    chunk.surface_hits.clear();
    chunk.x.clear();
    chunk.noise_shift.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const trace::Ray& ray = chunk.rays[i];
        const trace::Hit& hit = chunk.hits[i];
        chunk.add_cost(i, hit);
        if (hit.state == trace::HitState::miss) {
            radiance[i] = shaders::sky_radiance(scene_.sky, chunk.view[i]);
        } else if (hit.state == trace::HitState::unresolved) {
            radiance[i] = kUnresolvedRadiance;
            ++counters.unresolved_rays;
        } else {
            chunk.x.push_back(ray.origin + hit.s * ray.direction);
            if (field_.drifts()) chunk.noise_shift.push_back(ray.noise_shift);
            chunk.surface_hits.push_back(hit);
            chunk.lit.push_back({.sample = i, .view = chunk.view[i], .sun = chunk.sun[i], .distance = hit.s});
        }
    }
    chunk.normal.resize(chunk.x.size());
    meter.book(Phase::shading);
    traced = {};
    normals(chunk.surface_hits, chunk.x, chunk.noise_shift, chunk.normal, traced);
    meter.book(Phase::normals, traced);
    const bool is_planet = scene_.surface.kind == scene::SurfaceKind::planet;
    for (std::size_t i = 0; i < chunk.lit.size(); ++i) {
        Lit& lit = chunk.lit[i];
        lit.normal = glm::dvec3(chunk.normal[i]);
        if (!chunk.costs.empty() && !chunk.surface_hits[i].on_bound) {
            chunk.costs[lit.sample].noise_evaluations +=
                static_cast<std::uint32_t>(field_.octaves().size()) - chunk.surface_hits[i].octaves;
        }
        lit.height = is_planet ? field_.base(chunk.x[i]) : chunk.x[i].y;
        if (is_planet) lit.up = field_.base_gradient(chunk.x[i]);
    }

    if (scene::needs_shadow_rays(scene_.sun)) {
        meter.book(Phase::shading);
        shadow(chunk, counters, meter);
    }
    for (const Lit& lit : chunk.lit) radiance[lit.sample] = shade_hit(lit);
    counters.hits += chunk.lit.size();
    meter.book(Phase::shading);
}

// How far apart the shadow rays of neighbouring samples are, from the area of the surface that a sample stands for.
double SurfaceImage::shadow_spacing(const trace::Ray& ray, const Lit& lit) const {
    constexpr double kLeastCosine = 0.05;
    const double pixel = ray.delta_slope / scene_.sampling.tolerance * lit.distance;
    const double to_eye = std::max(std::abs(glm::dot(lit.normal, ray.direction)), kLeastCosine);
    const double to_sun = std::max(glm::dot(lit.normal, lit.sun), kLeastCosine);
    return pixel * std::sqrt(to_sun / to_eye) / samples_a_side_;
}

// A point of the convex bound that faces the sun sees it.
void SurfaceImage::shadow(Chunk& chunk, Counters& counters, PhaseMeter& meter) const {
    chunk.shadow_rays.clear();
    chunk.shadow_owner.clear();
    chunk.shadow_spacing.clear();
    for (std::size_t i = 0; i < chunk.lit.size(); ++i) {
        const Lit& lit = chunk.lit[i];
        const trace::Hit& hit = chunk.surface_hits[i];
        if (glm::dot(lit.normal, lit.sun) <= 0.0 || hit.on_bound) continue;
        chunk.shadow_rays.push_back(trace::shadow_ray(chunk.rays[lit.sample], hit, lit.normal, lit.sun));
        chunk.shadow_owner.push_back(i);
        if (sun_beams_) chunk.shadow_spacing.push_back(shadow_spacing(chunk.rays[lit.sample], lit));
    }
    trace::TraceCounters traced;
    if (sun_beams_) sun_beams_->shorten(chunk.shadow_rays, chunk.shadow_spacing, chunk.sunlit, traced);
    meter.book(Phase::sun_beams, traced);
    chunk.shadow_hits.resize(chunk.shadow_rays.size());
    traced = {};
    trace(chunk.shadow_rays, chunk.shadow_hits, traced);
    for (std::size_t i = 0; i < chunk.shadow_hits.size(); ++i) {
        const trace::HitState state = chunk.shadow_hits[i].state;
        chunk.add_cost(chunk.lit[chunk.shadow_owner[i]].sample, chunk.shadow_hits[i]);
        if (state != trace::HitState::miss) chunk.lit[chunk.shadow_owner[i]].visibility = 0.0;
        if (state == trace::HitState::unresolved) ++counters.unresolved_rays;
    }
    counters.shadow_rays += chunk.shadow_rays.size();
    meter.book(Phase::shadows, traced);
}

glm::vec3 SurfaceImage::shade_hit(const Lit& lit) const {
    const shaders::SurfacePoint point{.height = lit.height,
                                      .up_dot_normal = glm::dot(lit.up, lit.normal),
                                      .n_dot_sun = glm::dot(lit.normal, lit.sun),
                                      .sun_visibility = lit.visibility};
    const glm::vec3 surface = shaders::shade(scene_.material, scene_.sun, scene_.sky, point);
    return shaders::apply_haze(scene_.sky, surface, lit.distance, lit.view);
}

}  // namespace strata::render
