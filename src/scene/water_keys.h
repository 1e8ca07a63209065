// The keys of level water, and what it asks of a scene.
#pragma once

#include "src/scene/keys.h"

namespace strata::scene {

// matters: whether a surface is pictured.
Section describe_water(Water& water, bool matters);

// Throws SceneError where the scene has water that could not lie level, or an eye that is not above it.
void check_water(const Scene& scene);

}  // namespace strata::scene
