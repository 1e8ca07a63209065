// Every material. A new one is a file like its neighbours here, its #include and its name in the list; a scene has the
// first that is in it.
#pragma once

#include "shaders_cpu/closed_list.h"
#include "shaders_cpu/materials/terrain.h"
#include "shaders_cpu/shading_point.h"

namespace strata::shaders {

// reflectance: of a Lambert surface, linear RGB in [0,1].
template <class T>
concept MaterialMember = ListMember<T> && requires(const T material, const ShadingPoint& point) {
    { material.reflectance(point) } -> std::same_as<glm::vec3>;
};

template <MaterialMember... Members>
using MaterialList = std::variant<Members...>;

using Material = MaterialList<TerrainMaterial>;

}  // namespace strata::shaders
