#include "src/integrate/light.h"

#include <algorithm>
#include <cmath>

#include "shaders_cpu/sky.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/trace_rays.h"
#include "src/trace/shadow_ray.h"

namespace strata::integrate {

namespace {

// How far apart the shadow rays of neighbouring samples are, from the area of the surface that a sample stands for.
double shadow_spacing(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t i) {
    constexpr double kLeastCosine = 0.05;
    const scene::Sampling& sampling = setup.scene.sampling;
    const int samples_a_side = sampling.estimator == scene::EstimatorKind::none ? 1 : sampling.N;
    const trace::Ray& ray = chunk.ray_of_hit(i);
    const glm::dvec3 normal(chunk.normal[i]);
    const double pixel = ray.delta_slope / sampling.tolerance * chunk.surface_hits[i].s;
    const double to_eye = std::max(std::abs(glm::dot(normal, ray.direction)), kLeastCosine);
    const double to_sun = std::max(glm::dot(normal, chunk.sun_of_hit(i)), kLeastCosine);
    return pixel * std::sqrt(to_sun / to_eye) / samples_a_side;
}

// A point of the convex bound that faces the sun sees it.
void make_shadow_rays(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    ShadowRays& shadow = chunk.shadow;
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        const glm::dvec3 normal(chunk.normal[i]), sun = chunk.sun_of_hit(i);
        const trace::Hit& hit = chunk.surface_hits[i];
        if (glm::dot(normal, sun) <= 0.0 || hit.on_bound) continue;
        shadow.rays.push_back(trace::shadow_ray(chunk.ray_of_hit(i), hit, normal, sun));
        shadow.owner.push_back(static_cast<std::uint32_t>(i));
        if (setup.sun_beams) shadow.spacing.push_back(shadow_spacing(setup, chunk, i));
    }
}

// The same ground under daylight.
glm::vec3 shade_by_daylight(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t i) {
    const glm::dvec3 normal(chunk.normal[i]);
    const double height = chunk.x[i].y;
    const auto facing = static_cast<float>(std::max(glm::dot(normal, chunk.sun_of_hit(i)), 0.0)) * chunk.visibility[i] *
                        setup.daylight->sun_over_ridges(chunk.x[i]);
    const glm::vec3 light = setup.daylight->sun_on_white(height) * facing + setup.daylight->sky_on_white(normal);
    return setup.shader.albedo(height, normal.y) * light;
}

glm::vec3 sky_seen(const SurfaceSetup& setup, const glm::dvec3& direction) {
    return setup.daylight ? setup.daylight->sky(direction) : shaders::sky_radiance(setup.scene.sky, direction);
}

glm::vec3 shade_hit(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t i) {
    if (setup.daylight) return shade_by_daylight(setup, chunk, i);
    const glm::dvec3 normal(chunk.normal[i]);
    const bool is_planet = setup.scene.surface.kind == scene::SurfaceKind::planet;
    const glm::dvec3& x = chunk.x[i];
    return setup.shader.radiance(
        {.height = is_planet ? setup.field.base(x) : x.y,
         .up_dot_normal = is_planet ? glm::dot(setup.field.base_gradient(x), normal) : normal.y,
         .n_dot_sun = glm::dot(normal, chunk.sun_of_hit(i)),
         .sun_visibility = static_cast<double>(chunk.visibility[i])});
}

}  // namespace

void clear_shadows(SurfaceChunk& chunk) {
    chunk.shadow.clear();
    chunk.visibility.assign(chunk.sample.size(), 1.0f);
}

void cast_shadows(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    clear_shadows(chunk);
    ShadowRays& shadow = chunk.shadow;
    make_shadow_rays(setup, chunk);
    trace::TraceCounters traced;
    if (setup.sun_beams) setup.sun_beams->shorten(shadow.rays, shadow.spacing, shadow.sunlit, traced);
    meter.book(Phase::sun_beams, traced);

    traced = {};
    shadow.hits.resize(shadow.rays.size());
    trace_rays(setup, shadow.rays, shadow.hits, traced);
    for (std::size_t i = 0; i < shadow.hits.size(); ++i) {
        const trace::HitState state = shadow.hits[i].state;
        if (state != trace::HitState::miss) chunk.visibility[shadow.owner[i]] = 0.0f;
        if (state == trace::HitState::unresolved) ++counters.unresolved_rays;
    }
    counters.shadow_rays += shadow.rays.size();
    meter.book(Phase::shadows, traced);
}

void shade(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    chunk.radiance.resize(chunk.rays.size());
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        const trace::HitState state = chunk.hits[i].state;
        if (state == trace::HitState::miss) chunk.radiance[i] = sky_seen(setup, chunk.view_of(i));
        if (state == trace::HitState::unresolved) chunk.radiance[i] = kUnresolvedRadiance;
    }
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) chunk.radiance[chunk.sample[i]] = shade_hit(setup, chunk, i);
    meter.book(Phase::shading);
}

void light_hits(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    if (setup.has_shadows) {
        cast_shadows(setup, chunk, counters);
    } else {
        clear_shadows(chunk);
    }
    shade(setup, chunk, counters);
}

}  // namespace strata::integrate
