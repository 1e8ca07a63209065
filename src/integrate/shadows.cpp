#include "src/integrate/shadows.h"

#include <algorithm>
#include <cmath>

#include "src/integrate/directions.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/trace_rays.h"
#include "src/integrate/water.h"
#include "src/trace/shadow_ray.h"

namespace strata::integrate {

namespace {

// How far apart the shadow rays of neighbouring samples are, from the area of the surface that a sample stands for.
double shadow_spacing(const SurfaceSetup& setup, const SurfaceChunk& chunk, const glm::dvec3& to_light, std::size_t i) {
    constexpr double kLeastCosine = 0.05;
    const scene::Sampling& sampling = setup.scene.sampling;
    const trace::Ray& ray = chunk.ray_of_hit(i);
    const glm::dvec3 normal(chunk.normal[i]);
    const double pixel = ray.delta_slope / sampling.tolerance * chunk.surface_hits[i].s;
    const double to_eye = std::max(std::abs(glm::dot(normal, ray.direction)), kLeastCosine);
    const double facing = std::max(glm::dot(normal, to_light), kLeastCosine);
    return pixel * std::sqrt(facing / to_eye) / sampling.samples_a_side();
}

// Beams are for many rays that stand close together, as those from what the eye sees do and no others.
bool is_shortened(const SurfaceSetup& setup, std::size_t l, const SurfaceChunk& chunk) {
    return setup.lights[l].beams && chunk.depth == 0 && chunk.arrives.empty();
}

bool light_comes_to(const SurfaceSetup& setup, std::size_t l, const SurfaceChunk& chunk, std::size_t hit) {
    return std::visit([&](const auto& light) { return shaders::comes_to(light, chunk.x[hit]); }, setup.lights[l].light);
}

// A point of the convex bound that faces the light sees it.
void make_shadow_rays(const SurfaceSetup& setup, std::size_t l, SurfaceChunk& chunk) {
    ShadowRays& shadow = chunk.shadow;
    const bool by_beams = is_shortened(setup, l, chunk);
    shadow.spacing.clear();
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        const glm::dvec3 normal(chunk.normal[i]), to_light = chunk.to_light_of_hit(l, i);
        const trace::Hit& hit = chunk.surface_hits[i];
        if (glm::dot(normal, to_light) <= 0.0 || hit.on_bound) continue;
        if (!light_comes_to(setup, l, chunk, i)) {
            chunk.visibility_of(l)[i] = 0.0f;
            continue;
        }
        shadow.rays.push_back(trace::shadow_ray(chunk.ray_of_hit(i), hit, normal, to_light));
        shadow.owner.push_back(static_cast<std::uint32_t>(i));
        if (by_beams) shadow.spacing.push_back(shadow_spacing(setup, chunk, to_light, i));
    }
}

// Follows those from `first` on: whose rays meet something does not see the light.
void follow_shadow_rays(const SurfaceSetup& setup, std::size_t l, std::size_t first, SurfaceChunk& chunk,
                        Counters& counters, trace::TraceCounters& traced) {
    ShadowRays& shadow = chunk.shadow;
    const std::span<trace::Ray> rays = std::span(shadow.rays).subspan(first);
    shadow.hits.resize(shadow.rays.size());
    trace_rays(setup, rays, std::span(shadow.hits).subspan(first), traced);
    const std::span<float> visibility = chunk.visibility_of(l);
    for (std::size_t i = first; i < shadow.hits.size(); ++i) {
        const trace::HitState state = shadow.hits[i].state;
        if (state != trace::HitState::miss) visibility[shadow.owner[i]] = 0.0f;
        if (state == trace::HitState::unresolved) ++counters.unresolved_rays;
    }
    counters.shadow_rays += rays.size();
}

void cast_shadows_of(const SurfaceSetup& setup, std::size_t l, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    ShadowRays& shadow = chunk.shadow;
    const std::size_t first = shadow.rays.size();
    make_shadow_rays(setup, l, chunk);
    trace::TraceCounters traced;
    if (is_shortened(setup, l, chunk)) {
        const std::span<trace::Ray> rays = std::span(shadow.rays).subspan(first);
        setup.lights[l].beams->shorten(rays, shadow.spacing, shadow.sunlit, traced);
    }
    meter.book(Phase::sun_beams, traced);

    traced = {};
    const std::size_t over_water = shadow.rays.size();
    if (!chunk.arrives.empty()) stop_at_face(setup, std::span(shadow.rays).subspan(first));
    follow_shadow_rays(setup, l, first, chunk, counters, traced);
    if (!chunk.arrives.empty()) {
        go_on_over_water(setup, l, first, chunk);
        follow_shadow_rays(setup, l, over_water, chunk, counters, traced);
    }
    meter.book(Phase::shadows, traced);
}

}  // namespace

void choose_disc_points(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    const std::size_t hits = chunk.sample.size();
    chunk.to_disc.clear();
    if (!setup.has_discs) return;
    for (std::size_t l = 0; l < setup.lights.size(); ++l) {
        const double radius = setup.lights[l].angular_radius;
        const std::uint32_t pair = setup.disc_pair(chunk.depth, l);
        for (std::size_t i = 0; i < hits; ++i) {
            const glm::dvec3& middle = chunk.middle_of_light(l, i);
            const auto [u, v] = sample::dimension_pair(chunk.ids[chunk.sample[i]], pair);
            chunk.to_disc.push_back(radius > 0.0 ? disc_direction(middle, radius, u, v) : middle);
        }
    }
}

void clear_shadows(SurfaceChunk& chunk) {
    chunk.shadow.clear();
    chunk.visibility.clear();
}

void cast_shadows(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    chunk.shadow.clear();
    chunk.visibility.assign(setup.lights.size() * chunk.sample.size(), 1.0f);
    for (std::size_t l = 0; l < setup.lights.size(); ++l) {
        if (setup.lights[l].casts_shadows) cast_shadows_of(setup, l, chunk, counters);
    }
}

}  // namespace strata::integrate
