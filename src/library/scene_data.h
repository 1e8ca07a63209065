// What is behind a strata::Scene.
#pragma once

#include <string>

#include "src/scene/scene.h"
#include "src/strata.h"

namespace strata {

struct Scene::Data {
    scene::Scene scene;
    std::string source;  // for messages; empty: built by the caller
};

const Scene::Data& data_of(const Scene& scene);

// A copy of the scene that has passed all checks. Throws SceneError.
scene::Scene checked(const Scene& scene);

}  // namespace strata
