// Which of the built-in scenes a test renders.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "src/scene/builtin.h"

namespace strata::support {

// All of them; under sanitizers, where a picture takes thirty times as long, one in four. They look for faults of
// memory and for races, which do not depend on what a scene shows as much as counts do; the plainest, the default one
// and one with water are in.
inline std::vector<scene::BuiltinScene> builtins_to_render() {
    std::vector<scene::BuiltinScene> scenes = scene::builtin_scenes();
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    std::vector<scene::BuiltinScene> few;
    for (std::size_t i = 0; i < scenes.size(); i += 4) few.push_back(scenes[i]);
    for (const auto name : {std::string_view("hills"), scene::kDefaultScene, std::string_view("lake")}) {
        if (std::ranges::find(few, name, &scene::BuiltinScene::name) == few.end())
            few.push_back(*scene::find_builtin(name));
    }
    return few;
#else
    return scenes;
#endif
}

}  // namespace strata::support
