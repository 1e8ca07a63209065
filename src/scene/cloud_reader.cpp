#include "src/scene/cloud_reader.h"

#include "src/scene/cloud_keys.h"
#include "src/scene/named_list.h"

namespace strata::scene {

MaybeFault read_clouds(Scene& scene, const toml::node& node) {
    return read_named_list({kCloudLayers, "cumulus", kMostCloudLayers}, node, scene.clouds, describe_cloud_layer,
                           cloud_problem);
}

}  // namespace strata::scene
