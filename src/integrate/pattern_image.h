// The image-plane patterns of shaders_cpu as image functions.
#pragma once

#include <memory>

#include "src/integrate/image_function.h"
#include "src/scene/scene.h"

namespace strata::integrate {

// The pattern that scene.image names, over scene's frame. Counts a ray a sample. Throws std::invalid_argument when the
// scene's image is a surface.
std::unique_ptr<ImageFunction> make_pattern_image(const scene::Scene& scene);

}  // namespace strata::integrate
