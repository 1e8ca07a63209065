// The layers of a scene's clouds ([[clouds]] in a scene file) as sections of keys.
#pragma once

#include <span>
#include <string>

#include "src/scene/clouds.h"
#include "src/scene/keys.h"

namespace strata::scene {

inline constexpr std::size_t kMostCloudLayers = 8;

// The keys of a layer, as section `clouds.NAME`. The fields point into the layer.
Section describe_cloud_layer(CloudLayer& layer);

// Lattice cells of the layer's finest noise, in a metre.
double finest_cloud_cells(const CloudLayer& layer);

// What is wrong with layer i seen from those before it. It begins with the key's full name. Empty: nothing.
std::string cloud_problem(std::span<const CloudLayer> layers, std::size_t i);

}  // namespace strata::scene
