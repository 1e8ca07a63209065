// Every material. A new one is a file like its neighbours here, its #include and its name in the list; a scene has the
// first that is in it.
#pragma once

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/materials/layers.h"
#include "shaders_cpu/materials/terrain.h"
#include "shaders_cpu/shading_point.h"

namespace strata::shaders {

// reflectance: of a Lambert surface, linear RGB in [0,1].
template <class T>
concept MaterialMember = ListMember<T> && requires(const T material, const ShadingPoint& point) {
    { material.reflectance(point) } -> std::same_as<glm::vec3>;
};

// One that looks at the point's footprint, noise_shift and up. Where is_rough() says so, its look()
// counts instead of reflectance(): light from one direction is spread by rough_lobe.h.
template <class T>
concept DetailedMaterial = MaterialMember<T> && requires(const T material, const ShadingPoint& point) {
    { material.is_rough() } -> std::same_as<bool>;
    { material.look(point) } -> std::same_as<SurfaceLook>;
};

template <MaterialMember... Members>
using MaterialList = std::variant<Members...>;

using Material = MaterialList<LayersMaterial, TerrainMaterial>;

}  // namespace strata::shaders
