// The light that a white Lambert surface sends on is the mean over directions w of the hemisphere, by density p, of
// L(w) cos(n, w) / (pi p(w)). One direction a hit is drawn: by the cosine, which leaves L(w), or by an even mixture of
// that and of the background's own density, which leaves at most 2 L(w) wherever much light comes from few directions
// (one-sample multiple importance sampling by the balance heuristic: Veach and Guibas 1995).
#include "src/integrate/sky_rays.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "src/integrate/directions.h"
#include "src/integrate/inherit.h"
#include "src/integrate/light.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/resolve.h"
#include "src/integrate/trace_rays.h"
#include "src/integrate/water.h"
#include "src/trace/shadow_ray.h"

namespace strata::integrate {

namespace {

struct SkyDirection {
    glm::dvec3 direction;  // in the surface's axes
    double weight;         // cosine / (pi density)
};

// Backgrounds that know where their light comes from have sample() and pdf().
template <class Background>
SkyDirection draw(const Background& background, const glm::dvec3& normal, const glm::dmat3* to_sky, double u,
                  double v) {
    if constexpr (requires { background.sample(u, v); }) {
        const bool by_cosine = u < 0.5;
        u = by_cosine ? 2.0 * u : 2.0 * u - 1.0;
        glm::dvec3 seen;  // as the sky lies
        glm::dvec3 direction;
        if (by_cosine) {
            direction = cosine_direction(normal, u, v);
            seen = to_sky != nullptr ? *to_sky * direction : direction;
        } else {
            seen = background.sample(u, v);
            direction = to_sky != nullptr ? seen * *to_sky : seen;
        }
        const double cosine = glm::dot(normal, direction);
        if (cosine <= 0.0) return {direction, 0.0};
        const double density = 0.5 * (cosine * std::numbers::inv_pi + background.pdf(seen));
        return {direction, cosine * std::numbers::inv_pi / density};
    } else {
        return {cosine_direction(normal, u, v), 1.0};
    }
}

// A ray of weight 0, or from the convex bound, meets nothing and is not followed.
void aim_sky_rays(const SurfaceSetup& setup, const SurfaceChunk& chunk, SurfaceChunk& next) {
    const std::size_t count = chunk.sample.size();
    next.rays.resize(count);
    next.weight.resize(count);
    const std::uint32_t pair = setup.sky_pair(chunk.depth);
    const auto aim = [&](const auto& background) {
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 normal = glm::normalize(glm::dvec3(chunk.normal[i]));
            const auto [u, v] = sample::dimension_pair(chunk.ids[chunk.sample[i]], pair);
            const glm::dmat3* to_sky = chunk.to_sky.empty() ? nullptr : &chunk.to_sky[chunk.sample[i]];
            const auto [direction, weight] = draw(background, normal, to_sky, u, v);
            const trace::Hit& hit = chunk.surface_hits[i];
            next.rays[i] = trace::shadow_ray(chunk.ray_of_hit(i), hit, normal, direction);
            next.weight[i] = static_cast<float>(weight);
            if (weight == 0.0 || hit.on_bound) next.rays[i].start = std::numeric_limits<double>::infinity();
        }
    };
    std::visit(aim, setup.background);
    next.view.resize(next.to_sky.size());
    for (std::size_t i = 0; i < next.view.size(); ++i) next.view[i] = next.to_sky[i] * next.rays[i].direction;
}

glm::vec3 sky_ray_light(const SurfaceChunk& next, std::size_t i, float gain, bool hits_are_lit) {
    const trace::HitState state = next.hits[i].state;
    if (next.weight[i] == 0.0f) return glm::vec3(0.0f);
    if (state == trace::HitState::miss) return next.radiance[i] * (gain * next.weight[i]);
    const bool is_lit = state == trace::HitState::hit || state == trace::HitState::water;
    return is_lit && hits_are_lit ? next.radiance[i] * next.weight[i] : glm::vec3(0.0f);
}

// Light of the rays that met nothing, and of those that met what is lit, or water.
void add_up(const SurfaceSetup& setup, const SurfaceChunk& next, SurfaceChunk& chunk) {
    const auto gain = static_cast<float>(std::visit([](const auto& sky) { return sky.gain(); }, setup.background));
    const bool hits_are_lit = next.depth <= setup.scene.sky.bounces;
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
        const glm::vec3 light = sky_ray_light(next, i, gain, hits_are_lit);
        chunk.light[i] += chunk.arrives.empty() ? light : light * chunk.arriving(setup.lights.size(), i);
    }
}

// The last rays' hits send on nothing.
void forget_hits(SurfaceChunk& chunk, Counters& counters) {
    const auto is_unresolved = [](const trace::Hit& hit) { return hit.state == trace::HitState::unresolved; };
    counters.unresolved_rays += static_cast<std::uint64_t>(std::ranges::count_if(chunk.hits, is_unresolved));
    chunk.sample.clear();
    chunk.surface_hits.clear();
    chunk.x.clear();
    chunk.normal.clear();
    chunk.shadow.clear();
}

// What was booked as a picture's own rays was work for its sky rays.
void book(const Counters& work, std::size_t sky_rays, Counters& counters) {
    Counters all = work;
    all.hits = 0;
    all.sky_rays += sky_rays;
    const auto move = [&all](Phase from, Phase to) {
        PhaseCost& cost = all.phases[static_cast<std::size_t>(from)];
        all.phases[static_cast<std::size_t>(to)] += cost;
        cost = {};
    };
    move(Phase::rays, Phase::sky_rays);
    for (const Phase phase : {Phase::normals, Phase::sun_beams, Phase::shadows}) move(phase, Phase::bounces);
    counters += all;
}

}  // namespace

void gather_sky(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    if (!chunk.next) chunk.next = std::make_unique<SurfaceChunk>();
    SurfaceChunk& next = *chunk.next;
    Counters work;
    PhaseMeter meter(work);
    inherit(setup, chunk, chunk.sample, next);
    next.depth = chunk.depth + 1;
    aim_sky_rays(setup, chunk, next);
    stop_at_water(setup, next);
    meter.book(Phase::shading);
    trace::TraceCounters traced;
    next.hits.resize(next.rays.size());
    trace_rays(setup, next.rays, next.hits, traced);
    find_water(setup, next);
    meter.book(Phase::rays, traced);
    if (next.depth <= setup.scene.sky.bounces) {
        resolve_hits(setup, next, work);
        light_hits(setup, next, work);
    } else {
        forget_hits(next, work);
        shade(setup, next, work);
    }
    mirror_open_sky(setup, next);
    add_up(setup, next, chunk);
    book(work, next.rays.size(), counters);
}

}  // namespace strata::integrate
