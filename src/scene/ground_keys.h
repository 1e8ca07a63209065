// The layers of a scene's ground ([[ground]] in a scene file) as sections of keys.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "src/scene/ground.h"
#include "src/scene/keys.h"

namespace strata::scene {

inline constexpr std::size_t kMostGroundLayers = 32;

// The keys of a layer, as section `ground.NAME`. The fields point into the layer.
Section describe_ground_layer(GroundLayer& layer);

// Lattice cells of the finest noise that the layer reads, in a surface unit; 0: it reads none.
double finest_ground_cells(const GroundLayer& layer);

// What is wrong with layer i seen from those below it: its name, a range that is none, a mask of the lowest layer,
// which lies everywhere. It begins with the key's full name. Empty: nothing.
std::string ground_problem(std::span<const GroundLayer> layers, std::size_t i);

}  // namespace strata::scene
