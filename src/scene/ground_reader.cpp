#include "src/scene/ground_reader.h"

#include "src/scene/ground_keys.h"
#include "src/scene/named_list.h"

namespace strata::scene {

MaybeFault read_ground(Scene& scene, const toml::node& node) {
    return read_named_list({kGroundLayers, "snow", kMostGroundLayers}, node, scene.ground, describe_ground_layer,
                           ground_problem);
}

}  // namespace strata::scene
