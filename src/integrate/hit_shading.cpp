#include "src/integrate/hit_shading.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "shaders_cpu/rough_lobe.h"

namespace strata::integrate {

namespace {

// The width of a pixel where the ray ends is what the ray's tolerance there was made of. Of a slanting surface a pixel
// sees as much more as its cosine says, to some extent: far beyond it would only blur.
double footprint_of(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t hit) {
    constexpr double kLeastCosine = 1.0 / 16.0;
    const trace::Ray& ray = chunk.ray_of_hit(hit);
    const double tolerance = ray.delta0 + ray.delta_slope * chunk.surface_hits[hit].s;
    const double width = tolerance / setup.scene.sampling.tolerance;
    const double cosine = std::abs(glm::dot(glm::dvec3(chunk.normal[hit]), ray.direction));
    return width / std::sqrt(std::max(cosine, kLeastCosine));
}

}  // namespace

shaders::ShadingPoint detailed_point(const SurfaceSetup& setup, const SurfaceChunk& chunk, std::size_t hit) {
    shaders::ShadingPoint point = shading_point(chunk, hit);
    point.footprint = footprint_of(setup, chunk, hit);
    if (!chunk.noise_shift.empty()) point.noise_shift = chunk.noise_shift[hit];
    point.up = solid::visit([&](const auto& shape) { return shape.up(point.x); }, setup.field.solid());
    return point;
}

void look_at_ground(const SurfaceSetup& setup, SurfaceChunk& chunk) {
    chunk.looks.clear();
    const auto look = [&](const auto& material) {
        if constexpr (shaders::DetailedMaterial<std::remove_cvref_t<decltype(material)>>) {
            if (!material.is_rough()) return;
            for (std::size_t i = 0; i < chunk.sample.size(); ++i)
                chunk.looks.push_back(material.look(detailed_point(setup, chunk, i)));
        }
    };
    std::visit(look, setup.material);
}

float spread_to_eye(const SurfaceChunk& chunk, const shaders::ShadingPoint& point, std::size_t hit) {
    const shaders::RoughLobe lobe(chunk.looks[hit].roughness);
    return static_cast<float>(lobe(point.normal, point.to_light, -chunk.ray_of_hit(hit).direction));
}

}  // namespace strata::integrate
