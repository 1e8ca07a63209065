// What of all the lights, backgrounds, media and materials there are a scene has, and why: told when a render is
// explained, and by tests that go over all of them.
#pragma once

#include <string>
#include <vector>

#include "src/scene/scene.h"

namespace strata::shaders {

struct ScenePart {
    std::string name;
    bool is_needed;   // it changes the picture
    std::string why;  // what it does in this scene, or why nothing
};

// Of every list, in its order, whether the scene has it or not. The scene's image is `surface`, and it is valid.
std::vector<ScenePart> scene_parts(const scene::Scene& scene);

}  // namespace strata::shaders
