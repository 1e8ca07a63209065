// A bed of Lambert's kind under water of n: light of the sky comes in as 1 - even_light_reflected, a beam as
// 1 - fresnel, both lose by the way; of what the bed sends up a part leaves, spread to 1 / n^2 of its radiance, and
// the rest comes back down: shaders::Water says how much of each. Skylight is taken to come straight down over the
// point, and sky rays to go straight up; with white ground, an even sky and water that takes nothing the sum is exact.
#include "src/integrate/under_water.h"

#include <algorithm>
#include <limits>

#include "shaders_cpu/water_optics.h"
#include "src/integrate/hit_shading.h"
#include "src/integrate/inherit.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/resolve.h"
#include "src/integrate/shadows.h"
#include "src/integrate/sky_rays.h"
#include "src/integrate/trace_rays.h"
#include "src/integrate/water.h"
#include "src/integrate/water_glint.h"
#include "src/trace/shadow_ray.h"

namespace strata::integrate {

namespace {

constexpr glm::dvec3 kStraightUp{0.0, 1.0, 0.0};

// Refraction turns light down even where a wave leans; one that leans further than it can is taken to be level.
glm::dvec3 into_water(const glm::dvec3& direction, const glm::dvec3& facet) {
    const glm::dvec3 down = shaders::refracted(direction, facet);
    return down.y < -0.1 ? down : shaders::refracted(direction, kStraightUp);
}

// No ray is followed further than light comes from.
void aim_refracted(const SurfaceSetup& setup, const SurfaceChunk& chunk, SurfaceChunk& bed) {
    bed.rays.clear();
    for (const WaterHit& hit : chunk.water) {
        const glm::dvec3 down = into_water(chunk.rays[hit.sample].direction, hit.facet);
        trace::Ray& ray = bed.rays.emplace_back(ray_from_water(chunk, hit, down));
        ray.limit = std::min(farthest(setup), setup.water->sight());
    }
    bed.hits.resize(bed.rays.size());
}

double depth_at(const SurfaceSetup& setup, const glm::dvec3& x) { return std::max(setup.water->level() - x.y, 0.0); }

bool is_of_sun(const SceneLight& light) {
    return std::visit([]<class Light>(const Light&) { return Light::kLayer == shaders::LightLayer::sun; }, light.light);
}

// What comes of each light to the bed, and from where: chunk.arrives, and to_light turned steeper.
void bend_lights(const SurfaceSetup& setup, const std::vector<glm::dvec3>& over_water, SurfaceChunk& bed) {
    const std::size_t hits = bed.sample.size(), lights = setup.lights.size(), samples = bed.rays.size();
    bed.directions_a_light = samples;
    bed.to_light.resize(lights * samples);
    bed.arrives.resize((lights + 1) * hits);
    for (std::size_t l = 0; l < lights; ++l) {
        const glm::dvec3& to_light = over_water[l];
        glm::dvec3 below = to_light;
        if (to_light.y > 0.0) below = -shaders::refracted(-to_light, kStraightUp);
        std::fill_n(bed.to_light.begin() + static_cast<std::ptrdiff_t>(l * samples), samples, below);
        const bool is_beam = is_of_sun(setup.lights[l]);
        for (std::size_t i = 0; i < hits; ++i) {
            const double depth = depth_at(setup, bed.x[i]);
            bed.arrives[l * hits + i] =
                is_beam ? setup.water->beam_at(to_light, depth) : setup.water->even_light_at(depth);
        }
    }
    for (std::size_t i = 0; i < hits; ++i)
        bed.arrives[lights * hits + i] = setup.water->even_light_at(depth_at(setup, bed.x[i]));
}

void light_bed(const SurfaceSetup& setup, SurfaceChunk& bed, Counters& counters) {
    const std::vector<glm::dvec3> over_water = bed.to_light;
    bend_lights(setup, over_water, bed);
    choose_disc_points(setup, bed);
    if (setup.has_shadows) {
        cast_shadows(setup, bed, counters);
    } else {
        clear_shadows(bed);
    }
    illuminate(setup, bed, counters);
    bed.directions_a_light = 1;
    bed.to_light = over_water;
    if (setup.has_sky_rays) gather_sky(setup, bed, counters);
}

// From bed.light to bed.radiance at the water's face.
void show_bed(const SurfaceSetup& setup, SurfaceChunk& bed) {
    bed.radiance.assign(bed.rays.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < bed.rays.size(); ++i)
        if (bed.hits[i].state == trace::HitState::unresolved) bed.radiance[i] = kUnresolvedRadiance;
    const auto show = [&](const auto& material) {
        for (std::size_t i = 0; i < bed.sample.size(); ++i) {
            const glm::vec3 reflectance = reflectance_of(material, setup, bed, i);
            const glm::vec3 light = bed.light[i] * setup.water->again_and_again(reflectance, depth_at(setup, bed.x[i]));
            bed.radiance[bed.sample[i]] = reflectance * light * setup.water->left_after(bed.surface_hits[i].s);
        }
    };
    std::visit(show, setup.material);
}

void add_own_colour(const SurfaceSetup& setup, const SurfaceChunk& chunk, SurfaceChunk& bed) {
    constexpr double kNoBed = std::numeric_limits<double>::infinity();
    if (setup.water->is_clear()) return;
    std::size_t hit = 0;
    for (std::size_t i = 0; i < bed.rays.size(); ++i) {
        const bool is_hit = hit < bed.sample.size() && bed.sample[hit] == i;
        const double way = is_hit ? bed.surface_hits[hit].s : kNoBed;
        const double depth = is_hit ? depth_at(setup, bed.x[hit]) : kNoBed;
        if (is_hit) ++hit;
        bed.radiance[i] += setup.water->own_colour(chunk.face->light[i], way, depth);
    }
}

}  // namespace

void follow_refracted(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    SurfaceChunk& bed = *chunk.bed;
    PhaseMeter meter(counters);
    inherit(setup, chunk, samples_of(chunk.water), bed);
    aim_refracted(setup, chunk, bed);
    meter.book(Phase::shading);
    trace::TraceCounters traced;
    trace_rays(setup, bed.rays, bed.hits, traced);
    for (trace::Ray& ray : bed.rays) ray.limit = farthest(setup);  // as what goes on from it has it
    meter.book(Phase::rays, traced);
    resolve_hits(setup, bed, counters);
    light_bed(setup, bed, counters);
    meter.skip();
    show_bed(setup, bed);
    add_own_colour(setup, chunk, bed);
    meter.book(Phase::shading);
}

void stop_at_face(const SurfaceSetup& setup, std::span<trace::Ray> rays) {
    for (trace::Ray& ray : rays) {
        const double under = setup.water->level() - ray.origin.y;
        ray.limit = ray.direction.y > 0.0 ? std::clamp(under / ray.direction.y, 0.0, ray.limit) : ray.limit;
    }
}

void go_on_over_water(const SurfaceSetup& setup, std::size_t l, std::size_t first, SurfaceChunk& chunk) {
    ShadowRays& shadow = chunk.shadow;
    const std::size_t last = shadow.rays.size();
    const std::span<const float> visibility = chunk.visibility_of(l);
    for (std::size_t i = first; i < last; ++i) {
        if (visibility[shadow.owner[i]] == 0.0f) continue;
        trace::Ray ray = shadow.rays[i];
        const trace::Hit face{.state = trace::HitState::water, .s = ray.limit, .s_outside = ray.limit};
        if (ray.direction.y <= 0.0) continue;
        ray = trace::shadow_ray(ray, face, kStraightUp, shaders::out_of_water(ray.direction));
        ray.limit = farthest(setup);
        shadow.rays.push_back(ray);
        shadow.owner.push_back(shadow.owner[i]);
    }
}

}  // namespace strata::integrate
