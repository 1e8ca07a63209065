#pragma once

#include <memory>

#include "src/render/image_function.h"
#include "src/render/surface_image.h"

namespace strata::render {

// The image function of a valid scene, whatever its kind.
std::unique_ptr<ImageFunction> make_image(const scene::Scene& scene, Tracer tracer = Tracer::fast);

}  // namespace strata::render
