#include "src/integrate/water_glint.h"

#include <numbers>
#include <type_traits>

#include "shaders_cpu/sky.h"
#include "shaders_cpu/water_optics.h"
#include "src/integrate/inherit.h"
#include "src/integrate/phase_meter.h"
#include "src/integrate/shadows.h"
#include "src/integrate/under_water.h"

namespace strata::integrate {

namespace {

shaders::ShadingPoint face_point(const SurfaceSetup& setup, const glm::dvec3& x, const glm::dvec3& to_light,
                                 double time) {
    const double height = solid::visit([&](const auto& shape) { return shape.height(x); }, setup.field.solid());
    return {.x = x, .height = height, .to_light = to_light, .time = time};
}

// Of a light that nothing hides.
template <class Light>
glm::vec3 glint(const SurfaceSetup& setup, const SurfaceChunk& chunk, const Light& light, std::size_t l,
                const WaterHit& hit) {
    const std::size_t of_sample = chunk.directions_a_light == 1 ? 0 : hit.sample;
    const glm::dvec3& to_light = chunk.to_light[l * chunk.directions_a_light + of_sample];
    const glm::dvec3 to_eye = -chunk.rays[hit.sample].direction;
    const double mirrored = shaders::mirrored_beam(hit.waves, to_eye, to_light, light.angular_radius());
    if (mirrored <= 0.0) return glm::vec3(0.0f);
    const double cosine = glm::dot(to_eye, glm::normalize(to_eye + to_light));
    shaders::ShadingPoint point = face_point(setup, hit.x, to_light, chunk.time_of(hit.sample));
    point.normal = to_light;
    return light.on_white(point) * static_cast<float>(std::numbers::pi * shaders::fresnel(cosine) * mirrored);
}

void add_glints(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    for (std::size_t l = 0; l < setup.lights.size(); ++l) {
        const auto add = [&]<class Light>(const Light& light) {
            if constexpr (Light::kLayer == shaders::LightLayer::sun) {
                for (WaterHit& hit : chunk.water) hit.radiance += glint(setup, chunk, light, l, hit);
            }
        };
        std::visit(add, setup.lights[l].light);
    }
}

// Those points of the water at which it matters whether light arrives.
void make_face(const SurfaceSetup& setup, const SurfaceChunk& chunk, SurfaceChunk& face) {
    inherit(setup, chunk, samples_of(chunk.water), face);
    face.rays.clear();
    face.sample.clear();
    face.surface_hits.clear();
    face.x.clear();
    face.normal.clear();
    for (std::uint32_t i = 0; i < chunk.water.size(); ++i) {
        const WaterHit& hit = chunk.water[i];
        face.rays.push_back(chunk.rays[hit.sample]);
        if (setup.water->is_clear() && hit.radiance == glm::vec3(0.0f)) continue;
        const double way = chunk.to_water[hit.sample];
        face.sample.push_back(i);
        face.surface_hits.push_back({.state = trace::HitState::water, .s = way, .s_outside = way});
        face.x.push_back(hit.x);
        face.normal.emplace_back(0.0f, 1.0f, 0.0f);
    }
}

// The sky's light as if all of it were seen, where no light of the scene stands for it.
glm::vec3 open_sky_on_white(const SurfaceSetup& setup) {
    if (!setup.has_sky_rays) return glm::vec3(0.0f);
    if (setup.daylight) return setup.daylight->sky_on_white({0.0, 1.0, 0.0});
    return shaders::ambient_light(setup.scene.sky, 1.0);
}

void light_white_face(const SurfaceSetup& setup, SurfaceChunk& face) {
    face.light.assign(face.sample.size(), open_sky_on_white(setup));
    for (std::size_t l = 0; l < setup.lights.size(); ++l) {
        const auto add = [&](const auto& light) {
            for (std::size_t i = 0; i < face.sample.size(); ++i) {
                if (!face.sees_light(l, i)) continue;
                face.light[i] += light.on_white(
                    face_point(setup, face.x[i], face.to_light_of_hit(l, i), face.time_of(face.sample[i])));
            }
        };
        std::visit(add, setup.lights[l].light);
    }
}

// There is one sun: where it is hidden there is no glint.
void hide_glints(const SurfaceSetup& setup, const SurfaceChunk& face, SurfaceChunk& chunk) {
    for (std::size_t l = 0; l < setup.lights.size(); ++l) {
        if (!setup.lights[l].casts_shadows) continue;
        for (std::size_t i = 0; i < face.sample.size(); ++i)
            if (!face.sees_light(l, i)) chunk.water[face.sample[i]].radiance = glm::vec3(0.0f);
    }
}

}  // namespace

void light_face(const SurfaceSetup& setup, SurfaceChunk& chunk, Counters& counters) {
    SurfaceChunk& face = *chunk.face;
    PhaseMeter meter(counters);
    for (WaterHit& hit : chunk.water) hit.radiance = glm::vec3(0.0f);
    if (setup.has_waves()) add_glints(setup, chunk);
    make_face(setup, chunk, face);
    choose_disc_points(setup, face);
    meter.book(Phase::shading);
    if (setup.has_shadows) {
        cast_shadows(setup, face, counters);
    } else {
        clear_shadows(face);
    }
    meter.skip();
    hide_glints(setup, face, chunk);
    if (!setup.water->is_clear()) light_white_face(setup, face);
    meter.book(Phase::shading);
}

}  // namespace strata::integrate
