// The keys of the test patterns, which are pictured instead of a surface.
#pragma once

#include <vector>

#include "src/scene/keys.h"

namespace strata::scene {

// Appends a section a pattern; its keys matter if it is the one that is pictured.
void add_pattern_sections(Scene& scene, std::vector<Section>& sections);

}  // namespace strata::scene
