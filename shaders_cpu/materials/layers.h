// Layers of ground over each other, from the first, which lies everywhere, to the last. Each has colours and a mask
// that says how much of it lies where: the product of soft ranges over height, slope, the way it faces, a noise and
// beds along height.
//
//   kind, colour      what it is, of a palette of measured grounds, or a reflectance of its own
//   tone, second      how much of a second ground a noise mixes in
//   roughness         0: Lambert. Above: Oren-Nayar, for the sun's light
//   height_from, _to, _edge, _noise        surface units; ends that noise moves, and over how much they are soft
//   slope_from_deg, _to_deg, _edge_deg, slope_noise_deg
//   aspect, facing_from, _to, _edge        snow on the shaded side: aspect away from the sun
//   noise_from, _to, _edge                 patches; noise_size, _stretch, _octaves, _gain, _seed: of this noise
//   strata_from, _to, _edge                beds; strata_thickness, _length, _warp, ...: of these
//   cover             its share where it lies
//
//   [[ground]]
//   name = "rock"
//   kind = "granite"
//   roughness = 0.4
//   [[ground]]
//   name = "snow"
//   kind = "fresh_snow"
//   height_from = 0.2
//   height_noise = 0.05
//   slope_to_deg = 40.0
//   slope_noise_deg = 4.0
//   noise_size = 0.3
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/ground_mask.h"
#include "shaders_cpu/shading_point.h"

namespace strata::shaders {

class LayersMaterial {
  public:
    static constexpr auto kName = "layers of ground";

    static bool is_in(const scene::Scene& scene) { return !scene.ground.empty(); }

    static std::string why(const scene::Scene& scene) {
        if (!is_in(scene)) return "no [[ground]]: colour by [material]";
        return std::to_string(scene.ground.size()) + " of [[ground]], by height, slope, facing, noise and beds";
    }

    explicit LayersMaterial(const ShaderInputs& inputs) : LayersMaterial(inputs.scene) {}
    explicit LayersMaterial(const scene::Scene& scene);

    // Whether any layer is rough: else all is Lambert's.
    bool is_rough() const { return is_rough_; }

    // The mix of the layers' reflectances and roughnesses by their shares, which sum to 1: what a layer leaves
    // uncovered is shared out among those below.
    SurfaceLook look(const ShadingPoint& point) const;

    // These shares, of each layer.
    void shares(const ShadingPoint& point, std::span<float> shares) const;

    glm::vec3 reflectance(const ShadingPoint& point) const { return look(point).reflectance; }

  private:
    struct Layer {
        glm::dvec3 colour, to_second;  // the second less the first, times the largest share
        std::optional<GroundTexture> tone;
        double roughness;
        GroundMask mask;

        explicit Layer(const scene::GroundLayer& layer);
        glm::dvec3 albedo(const GroundPoint& point) const;
    };

    template <class See>
    void for_each_share(const GroundPoint& ground, const See& see) const;

    bool is_rough_;
    std::vector<Layer> layers_;
};

}  // namespace strata::shaders
