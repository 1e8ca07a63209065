#include "shaders_cpu/materials/layers.h"

#include <algorithm>
#include <limits>

#include "shaders_cpu/arc_cosine.h"

namespace strata::shaders {

namespace {

// Half the tone is mixed in where its noise is 0; all and nothing of it at 1.5 root mean squares.
const SmoothRange kToneRange({0.0, std::numeric_limits<double>::infinity(), 3.0},
                             -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());

glm::dvec3 colour_of(scene::GroundKind kind, const glm::dvec3& own) {
    if (kind == scene::GroundKind::own) return own;
    return scene::ground_palette()[static_cast<std::size_t>(kind)].albedo;
}

GroundPoint ground_point(const ShadingPoint& point) {
    return {.x = point.x + point.noise_shift,
            .normal = point.normal,
            .up = point.up,
            .height = point.height,
            .slope_deg = arc_cosine_deg(std::clamp(point.up_dot_normal, -1.0, 1.0)),
            .footprint = point.footprint};
}

}  // namespace

LayersMaterial::Layer::Layer(const scene::GroundLayer& layer)
    : colour(colour_of(layer.kind, layer.colour)),
      to_second((colour_of(layer.second, layer.second_colour) - colour) * layer.tone),
      roughness(layer.roughness),
      mask(layer) {
    if (layer.tone > 0.0) tone.emplace(layer.tone_noise);
}

glm::dvec3 LayersMaterial::Layer::albedo(const GroundPoint& point) const {
    if (!tone) return colour;
    const FilteredValue noise = tone->at(point);
    return colour + to_second * kToneRange(noise.value, noise.variance);
}

LayersMaterial::LayersMaterial(const scene::Scene& scene)
    : is_rough_(std::ranges::any_of(scene.ground, [](const auto& layer) { return layer.roughness > 0.0; })) {
    layers_.reserve(scene.ground.size());
    for (const scene::GroundLayer& layer : scene.ground) layers_.emplace_back(layer);
}

// see(layer, share) from the last layer down, as far as anything is left to see.
template <class See>
void LayersMaterial::for_each_share(const GroundPoint& ground, const See& see) const {
    double left = 1.0;
    for (std::size_t i = layers_.size(); i-- > 0 && left > 0.0;) {
        const double share = i == 0 ? left : left * layers_[i].mask(ground);
        left -= share;
        if (share != 0.0) see(i, share);
    }
}

void LayersMaterial::shares(const ShadingPoint& point, std::span<float> shares) const {
    for_each_share(ground_point(point), [&](std::size_t i, double share) { shares[i] = static_cast<float>(share); });
}

SurfaceLook LayersMaterial::look(const ShadingPoint& point) const {
    const GroundPoint ground = ground_point(point);
    glm::dvec3 reflectance(0.0);
    double roughness = 0.0;
    for_each_share(ground, [&](std::size_t i, double share) {
        reflectance += layers_[i].albedo(ground) * share;
        roughness += layers_[i].roughness * share;
    });
    return {glm::vec3(reflectance), roughness};
}

}  // namespace strata::shaders
