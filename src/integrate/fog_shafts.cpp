#include "src/integrate/fog_shafts.h"

#include <limits>
#include <stdexcept>

#include "src/integrate/directions.h"
#include "src/integrate/medium.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/trace_rays.h"

namespace strata::integrate {

namespace {

const shaders::Fog& fog_of(const SurfaceSetup& setup) {
    for (const shaders::Medium& medium : setup.media)
        if (const auto* fog = std::get_if<shaders::Fog>(&medium)) return *fog;
    throw std::logic_error("shafts without fog");
}

// How far along each ray fog is looked at; below 0 where a ray was not settled.
std::vector<double> ways_of(const SurfaceChunk& chunk) {
    std::vector<double> ways(chunk.rays.size(), -1.0);
    for (std::size_t i = 0; i < ways.size(); ++i)
        if (chunk.hits[i].state == trace::HitState::miss) ways[i] = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < chunk.sample.size(); ++i) ways[chunk.sample[i]] = chunk.surface_hits[i].s;
    for (const WaterHit& hit : chunk.water) ways[hit.sample] = chunk.hits[hit.sample].s;
    return ways;
}

glm::dvec3 to_sun(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t l, std::size_t i) {
    const glm::dvec3& middle = chunk.to_light[l * chunk.directions_a_light + (chunk.directions_a_light == 1 ? 0 : i)];
    const double radius = setup.lights[l].angular_radius;
    if (radius <= 0.0) return middle;
    const auto [u, v] = sample::dimension_pair(chunk.ids[i], setup.shaft_pair() + 1);
    return disc_direction(middle, radius, u, v);
}

// A ray through the open air up to there: it begins outside.
trace::Ray ray_from(const trace::Ray& seen, double way, const glm::dvec3& direction) {
    trace::Ray ray = seen;
    ray.origin += way * seen.direction;
    ray.delta0 += seen.delta_slope * way;
    ray.direction = direction;
    ray.start = 0.0;
    ray.hint = 0.0f;
    ray.window = nullptr;  // windows are along `seen`
    return ray;
}

// Light as if nothing hid the sun, and the rays that ask whether something does.
void aim_at_sun(const SurfaceSetup& setup, std::size_t l, SurfaceChunk& chunk) {
    const shaders::Fog& fog = fog_of(setup);
    const std::vector<double> ways = ways_of(chunk);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (ways[i] <= 0.0) continue;
        const double u = sample::dimension_pair(chunk.ids[i], setup.shaft_pair())[0];
        const shaders::Fog::Shaft shaft = fog.shaft(medium_ray(setup, chunk, i, ways[i]), u);
        chunk.in_fog[i] = shaft.sunlight;
        if (!setup.lights[l].casts_shadows || shaft.sunlight == glm::vec3(0.0f)) continue;
        chunk.shaft.rays.push_back(ray_from(chunk.rays[i], shaft.way, to_sun(setup, chunk, l, i)));
        chunk.shaft.owner.push_back(static_cast<std::uint32_t>(i));
    }
}

void follow(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters, trace::TraceCounters& traced) {
    ShadowRays& shaft = chunk.shaft;
    shaft.hits.resize(shaft.rays.size());
    trace_rays(setup, shaft.rays, shaft.hits, traced);
    for (std::size_t i = 0; i < shaft.hits.size(); ++i) {
        const trace::HitState state = shaft.hits[i].state;
        if (state != trace::HitState::miss) chunk.in_fog[shaft.owner[i]] = glm::vec3(0.0f);
        if (state == trace::HitState::unresolved) ++counters.unresolved_rays;
    }
    counters.shadow_rays += shaft.rays.size();
}

}  // namespace

void clear_shafts(SurfaceChunk& chunk) {
    chunk.shaft.clear();
    chunk.in_fog.clear();
}

void cast_shafts(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    clear_shafts(chunk);
    chunk.in_fog.assign(chunk.rays.size(), glm::vec3(0.0f));
    for (std::size_t l = 0; l < setup.lights.size(); ++l) {
        const auto is_sun = []<class Light>(const Light&) { return Light::kLayer == shaders::LightLayer::sun; };
        if (std::visit(is_sun, setup.lights[l].light)) aim_at_sun(setup, l, chunk);
    }
    meter.book(Phase::shading);
    trace::TraceCounters traced;
    follow(setup, chunk, counters, traced);
    meter.book(Phase::shadows, traced);
}

}  // namespace strata::integrate
