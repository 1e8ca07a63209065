// The terms of a relief, [[relief]] in a scene file.
#pragma once

#include <string_view>

#include "src/scene/scene.h"
#include "src/scene/toml_assign.h"

namespace strata::scene {

inline constexpr std::string_view kReliefTerms = "relief";

// Makes the node, an array of tables, the scene's relief.
MaybeFault read_relief(Scene& scene, const toml::node& node);

}  // namespace strata::scene
