#include "src/integrate/light.h"

#include <limits>

#include "src/integrate/hit_shading.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/sky_rays.h"

namespace strata::integrate {

namespace {

// Lists are asked which member they hold once a chunk, not once a sample.

// Rays from the ground to the sky see clouds at their mean, which costs no noise and is none. What the eye sees of
// clouds is a medium's affair.
void put_clouds_before(const SurfaceSetup& setup, SurfaceChunk& chunk, std::size_t i) {
    const shaders::MediumRay ray{chunk.rays[i].origin, chunk.view_of(i), std::numeric_limits<double>::infinity()};
    chunk.radiance[i] = setup.clouds->mean_along(ray).over(chunk.radiance[i]);
}

void shade_misses(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    const bool is_sky_ray = !chunk.weight.empty();
    const auto shade_by = [&](const auto& background) {
        for (std::size_t i = 0; i < chunk.rays.size(); ++i) {
            const trace::HitState state = chunk.hits[i].state;
            if (state == trace::HitState::miss) {
                chunk.radiance[i] = background.radiance(chunk.view_of(i));
                if (is_sky_ray && setup.clouds) put_clouds_before(setup, chunk, i);
            }
            if (state == trace::HitState::unresolved) chunk.radiance[i] = kUnresolvedRadiance;
        }
    };
    std::visit(shade_by, setup.background);
}

void find_heights(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    const std::size_t count = chunk.sample.size();
    chunk.height.resize(count);
    chunk.up_dot_normal.resize(count);
    const auto find = [&](const auto& solid) {
        for (std::size_t i = 0; i < count; ++i) {
            chunk.height[i] = solid.height(chunk.x[i]);
            chunk.up_dot_normal[i] = glm::dot(solid.up(chunk.x[i]), glm::dvec3(chunk.normal[i]));
        }
    };
    solid::visit(find, setup.field.solid());
}

void add_light(const SurfaceSetup& setup, std::size_t l, SurfaceChunk& chunk) {
    const std::span<const float> visibility = chunk.visibility_of(l);
    const auto add = [&](const auto& light) {
        for (std::size_t i = 0; i < chunk.sample.size(); ++i) {
            if (!visibility.empty() && visibility[i] == 0.0f) continue;
            const glm::vec3 on_white = light_on_white(light, chunk, l, i);
            chunk.light[i] += chunk.arrives.empty() ? on_white : on_white * chunk.arriving(l, i);
        }
    };
    std::visit(add, setup.lights[l].light);
}

void reflect(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    const auto reflect_by = [&](const auto& material) {
        for (std::size_t i = 0; i < chunk.sample.size(); ++i)
            chunk.radiance[chunk.sample[i]] = reflectance_of(material, setup, chunk, i) * chunk.light[i];
    };
    std::visit(reflect_by, setup.material);
}

}  // namespace

void illuminate(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    find_heights(setup, chunk);
    look_at_ground(setup, chunk);
    chunk.light.assign(chunk.sample.size(), glm::vec3(0.0f));
    for (std::size_t l = 0; l < setup.lights.size(); ++l) add_light(setup, l, chunk);
    meter.book(Phase::shading);
}

void shade(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    PhaseMeter meter(counters);
    chunk.radiance.resize(chunk.rays.size());
    shade_misses(setup, chunk);
    reflect(setup, chunk);
    meter.book(Phase::shading);
}

void light_hits(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    choose_disc_points(setup, chunk);
    if (setup.has_shadows) {
        cast_shadows(setup, chunk, counters);
    } else {
        clear_shadows(chunk);
    }
    illuminate(setup, chunk, counters);
    if (setup.has_sky_rays) gather_sky(setup, chunk, counters);
    shade(setup, chunk, counters);
}

}  // namespace strata::integrate
