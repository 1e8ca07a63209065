// The layers of clouds, [[clouds]] in a scene file.
#pragma once

#include <string_view>

#include "src/scene/scene.h"
#include "src/scene/toml_assign.h"

namespace strata::scene {

inline constexpr std::string_view kCloudLayers = "clouds";

// Makes the node, an array of tables, the scene's clouds.
MaybeFault read_clouds(Scene& scene, const toml::node& node);

}  // namespace strata::scene
