#include "src/render/surface_image.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "shaders_cpu/sky.h"
#include "shaders_cpu/terrain_material.h"
#include "src/scene/needs.h"
#include "src/trace/reference_tracer.h"
#include "src/trace/shadow_ray.h"

namespace strata::render {

namespace {

// Rays traced at once: enough to keep packets full, few enough for their data to stay in the second-level cache.
constexpr std::size_t kChunk = 1024;

void add(Counters& to, const trace::TraceCounters& from) {
    to.noise_evaluations += from.noise_evaluations;
    to.executed_lanes += from.executed_lanes;
    to.steps += from.steps;
}

}  // namespace

// A hit on its way to radiance, in the surface's coordinates.
struct SurfaceImage::Lit {
    std::size_t sample = 0;
    glm::dvec3 normal{0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 view{0.0};  // the ray's direction, as the sky lies
    glm::dvec3 sun{0.0};
    double height = 0.0;
    double distance = 0.0;
    double visibility = 1.0;
};

// What a chunk of samples needs on its way; one each call of evaluate(), its memory reused from chunk to chunk.
struct SurfaceImage::Chunk {
    std::vector<trace::Ray> rays, shadow_rays;
    std::vector<trace::Hit> hits, surface_hits, shadow_hits;
    std::vector<glm::dvec3> view, sun, x, noise_shift;
    std::vector<glm::vec3> normal;
    std::vector<Lit> lit;
    std::vector<std::size_t> shadow_owner;
    std::span<SampleCost> costs;  // empty: not asked for

    void add_cost(std::size_t sample, const trace::Hit& hit) {
        if (costs.empty()) return;
        costs[sample].steps += hit.steps;
        costs[sample].noise_evaluations += hit.noise_evaluations;
    }

    // What is filled hit by hit would be copied over and over while it grows: 5 to 8 % of a render.
    void reserve(std::size_t count, bool drifts, bool has_shadows) {
        surface_hits.reserve(count);
        x.reserve(count);
        lit.reserve(count);
        if (drifts) noise_shift.reserve(count);
        if (!has_shadows) return;
        shadow_rays.reserve(count);
        shadow_owner.reserve(count);
    }
};

SurfaceImage::SurfaceImage(const scene::Scene& scene, Tracer tracer, std::uint32_t step_limit)
    : scene_(scene),
      tracer_(tracer),
      step_limit_(step_limit),
      field_(scene.surface),
      fast_(field_),
      placement_(scene.surface),
      path_(scene.camera),
      camera_(path_.at(0.0), scene.film),
      sun_direction_(glm::normalize(scene.sun.direction)) {}

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

void SurfaceImage::gradients(std::span<const glm::dvec3> x, std::span<const glm::dvec3> noise_shift,
                             std::span<glm::vec3> gradient, trace::TraceCounters& counters) const {
    if (tracer_ == Tracer::fast) return fast_.gradients(x, noise_shift, gradient, counters);
    for (std::size_t i = 0; i < x.size(); ++i) {
        gradient[i] = glm::vec3(field_.gradient(x[i], noise_shift.empty() ? glm::dvec3(0.0) : noise_shift[i]));
    }
    counters.noise_evaluations += x.size() * field_.octaves().size();
    counters.executed_lanes += x.size() * field_.octaves().size();
}

// On the bound the noise has no part in the normal, and is not evaluated.
void SurfaceImage::gradients_off_bound(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                                       std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient,
                                       trace::TraceCounters& counters) const {
    std::vector<std::size_t> off_bound;
    std::vector<glm::dvec3> inner_x, inner_shift;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (hits[i].on_bound) continue;
        off_bound.push_back(i);
        inner_x.push_back(x[i]);
        if (!noise_shift.empty()) inner_shift.push_back(noise_shift[i]);
    }
    std::vector<glm::vec3> inner_gradient(inner_x.size());
    gradients(inner_x, inner_shift, inner_gradient, counters);
    for (std::size_t i = 0; i < off_bound.size(); ++i) gradient[off_bound[i]] = inner_gradient[i];
}

void SurfaceImage::normals(std::span<const trace::Hit> hits, std::span<const glm::dvec3> x,
                           std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> normal,
                           trace::TraceCounters& counters) const {
    if (std::ranges::any_of(hits, &trace::Hit::on_bound)) {
        gradients_off_bound(hits, x, noise_shift, normal, counters);
    } else {
        gradients(x, noise_shift, normal, counters);
    }
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
    Chunk chunk;
    chunk.reserve(std::min(kChunk, samples.u.size()), field_.drifts(), scene::needs_shadow_rays(scene_.sun));
    for (std::size_t begin = 0; begin < samples.u.size(); begin += kChunk) {
        const std::size_t count = std::min(kChunk, samples.u.size() - begin);
        const SampleBatch part{samples.u.subspan(begin, count), samples.v.subspan(begin, count),
                               samples.t.subspan(begin, count)};
        if (!costs.empty()) chunk.costs = costs.subspan(begin, count);
        evaluate_chunk(part, radiance.subspan(begin, count), chunk, counters);
    }
}

void SurfaceImage::evaluate_chunk(const SampleBatch& samples, std::span<glm::vec3> radiance, Chunk& chunk,
                                  Counters& counters) const {
    const std::size_t count = samples.u.size();
    trace::TraceCounters traced;

    // Rays of the camera at their own time, turned into the surface's coordinates at that time. The sky does not spin
    // with it.
    chunk.rays.resize(count);
    chunk.view.resize(count);
    chunk.sun.resize(count);
    glm::dmat3 orientation = placement_.orientation(0.0);
    glm::dvec3 sun = trace::Placement::direction_to_local(orientation, sun_direction_);
    std::optional<trace::Camera> moved;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = samples.t[i];
        const bool is_new_time = i == 0 || t != samples.t[i - 1];  // of an instant there is one
        if (placement_.moves() && is_new_time) {
            orientation = placement_.orientation(t);
            sun = trace::Placement::direction_to_local(orientation, sun_direction_);
        }
        if (path_.moves() && is_new_time) moved.emplace(path_.at(t), scene_.film);
        const trace::Ray world = camera_ray(moved ? *moved : camera_, samples.u[i], samples.v[i]);
        chunk.rays[i] = to_local(orientation, world, t);
        chunk.view[i] = trace::Placement::direction_to_local(placement_.resting_orientation(), world.direction);
        chunk.sun[i] = sun;
    }
    chunk.hits.resize(count);
    trace(chunk.rays, chunk.hits, traced);

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
    normals(chunk.surface_hits, chunk.x, chunk.noise_shift, chunk.normal, traced);
    const bool is_planet = scene_.surface.kind == scene::SurfaceKind::planet;
    for (std::size_t i = 0; i < chunk.lit.size(); ++i) {
        Lit& lit = chunk.lit[i];
        lit.normal = glm::dvec3(chunk.normal[i]);
        if (!chunk.costs.empty() && !chunk.surface_hits[i].on_bound) {
            chunk.costs[lit.sample].noise_evaluations += static_cast<std::uint32_t>(field_.octaves().size());
        }
        lit.height = is_planet ? field_.base(chunk.x[i]) : chunk.x[i].y;
        if (is_planet) lit.up = field_.base_gradient(chunk.x[i]);
    }
    add(counters, traced);

    if (scene::needs_shadow_rays(scene_.sun)) shadow(chunk, counters);
    for (const Lit& lit : chunk.lit) radiance[lit.sample] = shade_hit(lit);
    counters.hits += chunk.lit.size();
}

// A point of the convex bound that faces the sun sees it.
void SurfaceImage::shadow(Chunk& chunk, Counters& counters) const {
    chunk.shadow_rays.clear();
    chunk.shadow_owner.clear();
    for (std::size_t i = 0; i < chunk.lit.size(); ++i) {
        const Lit& lit = chunk.lit[i];
        const trace::Hit& hit = chunk.surface_hits[i];
        if (glm::dot(lit.normal, lit.sun) <= 0.0 || hit.on_bound) continue;
        chunk.shadow_rays.push_back(trace::shadow_ray(chunk.rays[lit.sample], hit, lit.normal, lit.sun));
        chunk.shadow_owner.push_back(i);
    }
    chunk.shadow_hits.resize(chunk.shadow_rays.size());
    trace::TraceCounters traced;
    trace(chunk.shadow_rays, chunk.shadow_hits, traced);
    for (std::size_t i = 0; i < chunk.shadow_hits.size(); ++i) {
        const trace::HitState state = chunk.shadow_hits[i].state;
        chunk.add_cost(chunk.lit[chunk.shadow_owner[i]].sample, chunk.shadow_hits[i]);
        if (state != trace::HitState::miss) chunk.lit[chunk.shadow_owner[i]].visibility = 0.0;
        if (state == trace::HitState::unresolved) ++counters.unresolved_rays;
    }
    counters.shadow_rays += chunk.shadow_rays.size();
    add(counters, traced);
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
