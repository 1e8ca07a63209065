#pragma once

#include <memory>

#include "src/integrate/image_function.h"
#include "src/integrate/surface_image.h"

namespace strata::integrate {

// The image function of a valid scene, whatever its kind.
std::unique_ptr<ImageFunction> make_image(const scene::Scene& scene, Tracer tracer = Tracer::fast);

}  // namespace strata::integrate
