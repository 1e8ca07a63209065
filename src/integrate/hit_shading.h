// What a hit of a chunk that went through illuminate does with light, for the stage of light.h and for channels.
#pragma once

#include <glm/glm.hpp>

#include "shaders_cpu/lights/all.h"
#include "shaders_cpu/materials/all.h"
#include "src/integrate/light.h"

namespace strata::integrate {

// shading_point with what a DetailedMaterial looks at.
shaders::ShadingPoint detailed_point(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t hit);

// chunk.looks.
void look_at_ground(const SurfaceSetup& setup, SurfaceChunk& chunk);

// What the hit's rough surface sends to the eye of the light that the point names, against Lambert's.
float spread_to_eye(const SurfaceChunk& chunk, const shaders::ShadingPoint& point, std::size_t hit);

template <shaders::MaterialMember Material>
glm::vec3 reflectance_of(const Material& material, const SurfaceSetup& setup, const SurfaceChunk& chunk,
                         std::size_t hit) {
    if constexpr (shaders::DetailedMaterial<Material>) {
        if (!chunk.looks.empty()) return chunk.looks[hit].reflectance;
        return material.reflectance(detailed_point(setup, chunk, hit));
    } else {
        return material.reflectance(shading_point(chunk, hit));
    }
}

// Radiance towards the eye of light l on a white surface as rough as the hit's, with nothing in its way.
template <shaders::LightMember Light>
glm::vec3 light_on_white(const Light& light, const SurfaceChunk& chunk, std::size_t l, std::size_t hit) {
    shaders::ShadingPoint point = shading_point(chunk, hit);
    point.to_light = chunk.to_light_of_hit(l, hit);
    glm::vec3 radiance = light.on_white(point);
    if constexpr (Light::kLayer == shaders::LightLayer::sun) {
        if (!chunk.looks.empty()) radiance *= spread_to_eye(chunk, point, hit);
    }
    return radiance;
}

}  // namespace strata::integrate
