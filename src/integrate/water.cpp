#include "src/integrate/water.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shaders_cpu/water_optics.h"
#include "src/integrate/inherit.h"
#include "src/integrate/light.h"
#include "src/integrate/medium.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/resolve.h"
#include "src/integrate/trace_rays.h"
#include "src/integrate/under_water.h"
#include "src/integrate/water_glint.h"
#include "src/trace/shadow_ray.h"

namespace strata::integrate {

namespace {

constexpr double kNoWater = std::numeric_limits<double>::infinity();

// Along a ray, infinite for one that does not come to it from above.
double way_to_water(const shaders::Water& water, const trace::Ray& ray) {
    const double over = ray.origin.y - water.level();
    if (over <= 0.0 || ray.direction.y >= 0.0) return kNoWater;
    const double way = -over / ray.direction.y;
    return way < ray.limit ? way : kNoWater;
}

// Side of a square as large as what a sample's pixel sees of the level. The pixel is long where the eye grazes: far
// beyond its width that would only blur what the pixel can tell across.
double footprint_on(const SurfaceSetup& setup, const trace::Ray& ray, double way) {
    constexpr double kLeastCosine = 1.0 / 256.0;
    const double width = (ray.delta0 + ray.delta_slope * way) / setup.scene.sampling.tolerance;
    return width / std::sqrt(std::max(-ray.direction.y, kLeastCosine));
}

WaterHit water_hit(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::uint32_t sample) {
    const trace::Ray& ray = chunk.rays[sample];
    const double way = chunk.to_water[sample];
    WaterHit hit{};
    hit.sample = sample;
    hit.x = ray.origin + way * ray.direction;
    hit.x.y = setup.water->level();
    hit.facet = hit.normal = {0.0, 1.0, 0.0};
    if (setup.has_waves()) {
        hit.waves = setup.water->waves().at(hit.x, footprint_on(setup, ray, way));
        hit.normal = shaders::normal_of_slope(hit.waves.mean);
        const auto [u, v] = sample::dimension_pair(chunk.ids[sample], setup.facet_pair());
        hit.facet = shaders::normal_of_slope(shaders::VisibleFacets(hit.waves, -ray.direction).draw(u, v));
    }
    hit.reflected = shaders::fresnel(-glm::dot(ray.direction, hit.facet));
    return hit;
}

void gather_water(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    for (std::uint32_t i = 0; i < chunk.hits.size(); ++i)
        if (chunk.hits[i].state == trace::HitState::water) chunk.water.push_back(water_hit(setup, chunk, i));
}

// A facet that leans far sends some light down, on to another facet: it is taken to go up from there as steeply.
glm::dvec3 mirrored(const glm::dvec3& direction, const glm::dvec3& facet) {
    const glm::dvec3 up = direction - 2.0 * glm::dot(direction, facet) * facet;
    return glm::normalize(glm::dvec3(up.x, std::abs(up.y), up.z));
}

void follow_mirrored(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    SurfaceChunk& up = *chunk.mirrored;
    PhaseMeter meter(counters);
    inherit(setup, chunk, samples_of(chunk.water), up);
    up.rays.clear();
    for (const WaterHit& hit : chunk.water) {
        const glm::dvec3& seen = chunk.rays[hit.sample].direction;
        up.rays.push_back(ray_from_water(chunk, hit, mirrored(seen, hit.facet)));
    }
    up.hits.resize(up.rays.size());
    meter.book(Phase::shading);
    trace::TraceCounters traced;
    trace_rays(setup, up.rays, up.hits, traced);
    meter.book(Phase::rays, traced);
    resolve_hits(setup, up, counters);
    light_hits(setup, up, counters);
    apply_medium(setup, up, counters);
}

void add_up(SurfaceChunk& chunk) {
    for (std::size_t i = 0; i < chunk.water.size(); ++i) {
        WaterHit& hit = chunk.water[i];
        const auto reflected = static_cast<float>(hit.reflected);
        hit.radiance += reflected * chunk.mirrored->radiance[i] + (1.0f - reflected) * chunk.bed->radiance[i];
        chunk.radiance[hit.sample] = hit.radiance;
    }
}

// All is booked as work for water.
void book_water(const Counters& work, std::size_t rays, Counters& counters) {
    Counters all = work;
    all.hits = 0;
    all.water_rays += rays;
    PhaseCost& water = all.phases[static_cast<std::size_t>(Phase::water)];
    for (std::size_t i = 0; i < kPhases; ++i) {
        if (i == static_cast<std::size_t>(Phase::water) || i == static_cast<std::size_t>(Phase::shading)) continue;
        water += all.phases[i];
        all.phases[i] = {};
    }
    counters += all;
}

}  // namespace

double farthest(const SurfaceSetup& setup) { return setup.scene.camera.far / setup.placement.scale(); }

std::vector<std::uint32_t> samples_of(const std::vector<WaterHit>& water) {
    std::vector<std::uint32_t> samples;
    samples.reserve(water.size());
    for (const WaterHit& hit : water) samples.push_back(hit.sample);
    return samples;
}

trace::Ray ray_from_water(const SurfaceChunk& chunk, const WaterHit& hit, const glm::dvec3& direction) {
    const double way = chunk.to_water[hit.sample];
    const trace::Hit at{.state = trace::HitState::water, .s = way, .s_outside = way};
    const glm::dvec3 side{0.0, direction.y < 0.0 ? -1.0 : 1.0, 0.0};
    return trace::shadow_ray(chunk.rays[hit.sample], at, side, direction);
}

void stop_at_water(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    if (!setup.water) return;
    chunk.to_water.resize(chunk.rays.size());
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        chunk.to_water[i] = way_to_water(*setup.water, chunk.rays[i]);
        chunk.rays[i].limit = std::min(chunk.rays[i].limit, chunk.to_water[i]);
    }
}

// A landing may lie a little beyond the end of its ray.
void find_water(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    if (!setup.water) return;
    for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
        trace::Hit& hit = chunk.hits[i];
        chunk.rays[i].limit = farthest(setup);  // as what goes on from it has it
        if (chunk.to_water[i] == kNoWater || hit.state == trace::HitState::unresolved) continue;
        if (hit.state == trace::HitState::hit && hit.s <= chunk.to_water[i]) continue;
        hit.state = trace::HitState::water;
        hit.s = chunk.to_water[i];
    }
}

void light_water(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    chunk.water.clear();
    if (!setup.water) return;
    PhaseMeter meter(counters);
    gather_water(setup, chunk);
    meter.book(Phase::shading);
    if (chunk.water.empty()) return;
    for (std::unique_ptr<SurfaceChunk>* of : {&chunk.mirrored, &chunk.bed, &chunk.face})
        if (!*of) *of = std::make_unique<SurfaceChunk>();
    Counters work;
    light_face(setup, chunk, work);
    follow_mirrored(setup, chunk, work);
    follow_refracted(setup, chunk, work);
    add_up(chunk);
    book_water(work, 2 * chunk.water.size(), counters);
}

void mirror_open_sky(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    if (!setup.water) return;
    const auto mirror = [&](const auto& background) {
        for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
            if (chunk.hits[i].state != trace::HitState::water) continue;
            const glm::dvec3& down = chunk.rays[i].direction;
            const auto reflected = static_cast<float>(shaders::fresnel(-down.y));
            chunk.radiance[i] = reflected * background.radiance({down.x, -down.y, down.z});
        }
    };
    std::visit(mirror, setup.background);
}

}  // namespace strata::integrate
