// Scene files out.
#pragma once

#include <string>

#include "src/scene/scene.h"

namespace strata::scene {

enum class PrintedKeys {
    that_matter,  // and the rest where it differs from the defaults
    all
};

// The scene as TOML: every key with its value and, in a comment, what it allows, its unit, default and meaning; of a
// key that several [[terms]] have, at the first of them. Reading it back gives the same scene to the bit.
std::string print_scene(const Scene& scene, PrintedKeys keys = PrintedKeys::that_matter);

}  // namespace strata::scene
