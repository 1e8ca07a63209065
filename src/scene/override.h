// --set on the command line: one key of a scene replaced.
#pragma once

#include <string_view>

#include "src/scene/scene.h"
#include "src/scene/scene_error.h"

namespace strata::scene {

// `camera.fov_deg=35`: any key, its value in TOML, strings of plain words without quotes. `relief.seed=7` adds 7 to the
// seeds of all terms of the relief. option is what the user
// typed, for the message; empty: `--set assignment`. On SceneError the scene is as before.
void apply_override(Scene& scene, std::string_view assignment, std::string_view option = {});

}  // namespace strata::scene
