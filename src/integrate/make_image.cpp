#include "src/integrate/make_image.h"

#include "src/integrate/pattern_image.h"

namespace strata::integrate {

std::unique_ptr<ImageFunction> make_image(const scene::Scene& scene, Tracer tracer) {
    if (scene.image == scene::ImageKind::surface) return std::make_unique<SurfaceImage>(scene, tracer);
    return make_pattern_image(scene);
}

}  // namespace strata::integrate
