// The layers of the ground, [[ground]] in a scene file.
#pragma once

#include <string_view>

#include "src/scene/scene.h"
#include "src/scene/toml_assign.h"

namespace strata::scene {

inline constexpr std::string_view kGroundLayers = "ground";

// Makes the node, an array of tables, the scene's ground.
MaybeFault read_ground(Scene& scene, const toml::node& node);

}  // namespace strata::scene
