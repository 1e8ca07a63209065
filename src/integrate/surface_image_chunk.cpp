// From a chunk of samples to their radiance: rays, hits, normals, light.
#include "src/integrate/surface_image_chunk.h"

#include <algorithm>
#include <cmath>

#include "shaders_cpu/sky.h"
#include "src/integrate/phase_meter.h"
#include "src/scene/needs.h"
#include "src/trace/shadow_ray.h"

namespace strata::integrate {

SurfaceImage::Instant SurfaceImage::instant(double t) const {
    const trace::Camera camera = path_.moves() ? trace::Camera(path_.at(t), scene_.film) : camera_;
    const glm::dmat3 orientation = placement_.orientation(t);
    const trace::Ray world = camera_ray(camera, 0.5 * scene_.film.width, 0.5 * scene_.film.height);
    return {orientation, world, camera.turned(orientation), to_local(orientation, world, t)};
}

void SurfaceImage::set_time(Instant& now, double t) const {
    if (path_.moves() || placement_.moves()) {
        now = instant(t);
    } else if (field_.drifts()) {
        now.ray = to_local(now.orientation, now.world, t);
    }
}

void SurfaceImage::aim(const Instant& now, double u, double v, trace::Ray& ray) const {
    const trace::CameraRay seen = now.eye.ray(u, v);
    ray = now.ray;
    trace::Placement::aim(ray, seen.direction, scene_.sampling.tolerance * seen.pixel_angle);
}

trace::Ray SurfaceImage::local_camera_ray(double u, double v, double t) const {
    trace::Ray ray;
    aim(instant(t), u, v, ray);
    return ray;
}

// Rays of the camera at their own time, turned into the surface's coordinates at that time. The sky does not spin with
// it.
void SurfaceImage::make_rays(const SampleBatch& samples, Chunk& chunk) const {
    const std::size_t count = samples.u.size();
    const bool spins = placement_.moves();
    chunk.rays.resize(count);
    chunk.view.resize(spins ? count : 0);
    chunk.sun.resize(spins ? count : 1);
    if (count == 0) return;
    Instant now = instant(samples.t[0]);
    glm::dvec3 sun = trace::Placement::direction_to_local(now.orientation, sun_direction_);
    chunk.sun.front() = sun;
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && samples.t[i] != samples.t[i - 1]) {  // of an instant there is one
            set_time(now, samples.t[i]);
            if (spins) sun = trace::Placement::direction_to_local(now.orientation, sun_direction_);
        }
        trace::Ray& ray = chunk.rays[i];
        aim(now, samples.u[i], samples.v[i], ray);
        if (!chunk.start.empty()) {
            ray.start = chunk.start[i];
            ray.hint = chunk.hint[i];
            ray.window = chunk.window[i];
        }
        if (!spins) continue;
        chunk.view[i] =
            trace::Placement::direction_to_local(placement_.resting_orientation(), now.orientation * ray.direction);
        chunk.sun[i] = sun;
    }
}

// What was hit is gathered; the rest is sky.
void SurfaceImage::gather_hits(std::span<glm::vec3> radiance, Chunk& chunk, Counters& counters) const {
    chunk.lit.clear();
    chunk.surface_hits.clear();
    chunk.x.clear();
    chunk.noise_shift.clear();
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        const trace::Ray& ray = chunk.rays[i];
        const trace::Hit& hit = chunk.hits[i];
        chunk.add_cost(i, hit);
        if (hit.state == trace::HitState::miss) {
            radiance[i] = shaders::sky_radiance(scene_.sky, chunk.view_of(i));
        } else if (hit.state == trace::HitState::unresolved) {
            radiance[i] = kUnresolvedRadiance;
            ++counters.unresolved_rays;
        } else {
            chunk.x.push_back(ray.origin + hit.s * ray.direction);
            if (field_.drifts()) chunk.noise_shift.push_back(ray.noise_shift);
            chunk.surface_hits.push_back(hit);
            chunk.lit.push_back({.sample = static_cast<std::uint32_t>(i)});
        }
    }
}

void SurfaceImage::evaluate_chunk(const SampleBatch& samples, std::span<glm::vec3> radiance, Chunk& chunk,
                                  Counters& counters) const {
    PhaseMeter meter(counters);
    make_rays(samples, chunk);
    chunk.hits.resize(samples.u.size());
    meter.book(Phase::shading);

    trace::TraceCounters traced;
    trace(chunk.rays, chunk.hits, traced);
    meter.book(Phase::rays, traced);

    gather_hits(radiance, chunk, counters);
    chunk.normal.resize(chunk.x.size());
    meter.book(Phase::shading);

    traced = {};
    normals(chunk.surface_hits, chunk.x, chunk.noise_shift, chunk.normal, traced);
    meter.book(Phase::normals, traced);

    chunk.add_normals_costs(static_cast<std::uint32_t>(field_.octaves().size()));
    if (scene::needs_shadow_rays(scene_.sun)) {
        meter.book(Phase::shading);
        shadow(chunk, counters, meter);
    }
    for (std::size_t i = 0; i < chunk.lit.size(); ++i) radiance[chunk.lit[i].sample] = shade_hit(chunk, i);
    counters.hits += chunk.lit.size();
    meter.book(Phase::shading);
}

// How far apart the shadow rays of neighbouring samples are, from the area of the surface that a sample stands for.
double SurfaceImage::shadow_spacing(const Chunk& chunk, std::size_t i) const {
    constexpr double kLeastCosine = 0.05;
    const trace::Ray& ray = chunk.ray_of(i);
    const glm::dvec3 normal(chunk.normal[i]);
    const double pixel = ray.delta_slope / scene_.sampling.tolerance * chunk.surface_hits[i].s;
    const double to_eye = std::max(std::abs(glm::dot(normal, ray.direction)), kLeastCosine);
    const double to_sun = std::max(glm::dot(normal, chunk.sun_of(i)), kLeastCosine);
    return pixel * std::sqrt(to_sun / to_eye) / samples_a_side_;
}

// A point of the convex bound that faces the sun sees it.
void SurfaceImage::shadow(Chunk& chunk, Counters& counters, PhaseMeter& meter) const {
    chunk.shadow_rays.clear();
    chunk.shadow_owner.clear();
    chunk.shadow_spacing.clear();
    for (std::size_t i = 0; i < chunk.lit.size(); ++i) {
        const glm::dvec3 normal(chunk.normal[i]), sun = chunk.sun_of(i);
        const trace::Hit& hit = chunk.surface_hits[i];
        if (glm::dot(normal, sun) <= 0.0 || hit.on_bound) continue;
        chunk.shadow_rays.push_back(trace::shadow_ray(chunk.ray_of(i), hit, normal, sun));
        chunk.shadow_owner.push_back(i);
        if (sun_beams_) chunk.shadow_spacing.push_back(shadow_spacing(chunk, i));
    }
    trace::TraceCounters traced;
    if (sun_beams_) sun_beams_->shorten(chunk.shadow_rays, chunk.shadow_spacing, chunk.sunlit, traced);
    meter.book(Phase::sun_beams, traced);
    chunk.shadow_hits.resize(chunk.shadow_rays.size());
    traced = {};
    trace(chunk.shadow_rays, chunk.shadow_hits, traced);
    for (std::size_t i = 0; i < chunk.shadow_hits.size(); ++i) {
        const trace::HitState state = chunk.shadow_hits[i].state;
        Lit& lit = chunk.lit[chunk.shadow_owner[i]];
        chunk.add_cost(lit.sample, chunk.shadow_hits[i]);
        if (state != trace::HitState::miss) lit.visibility = 0.0f;
        if (state == trace::HitState::unresolved) ++counters.unresolved_rays;
    }
    counters.shadow_rays += chunk.shadow_rays.size();
    meter.book(Phase::shadows, traced);
}

glm::vec3 SurfaceImage::shade_hit(const Chunk& chunk, std::size_t i) const {
    const glm::dvec3 normal(chunk.normal[i]);
    const bool is_planet = scene_.surface.kind == scene::SurfaceKind::planet;
    const glm::dvec3& x = chunk.x[i];
    const shaders::SurfacePoint point{.height = is_planet ? field_.base(x) : x.y,
                                      .up_dot_normal = is_planet ? glm::dot(field_.base_gradient(x), normal) : normal.y,
                                      .n_dot_sun = glm::dot(normal, chunk.sun_of(i)),
                                      .sun_visibility = static_cast<double>(chunk.lit[i].visibility)};
    const glm::vec3 surface = shader_.radiance(point);
    return shaders::apply_haze(scene_.sky, surface, chunk.surface_hits[i].s, chunk.view_of(chunk.lit[i].sample));
}

}  // namespace strata::integrate
