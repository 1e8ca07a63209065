#include "src/render/bounding_ball.h"

#include <limits>

namespace strata::render {

double bounding_ball(const trace::Field& field) {
    constexpr double kPad = 1.0 + 1e-9;
    const scene::Surface& surface = field.surface();
    switch (surface.kind) {
        case scene::SurfaceKind::terrain:
        case scene::SurfaceKind::hyperterrain:
            break;
        case scene::SurfaceKind::planet:
            return (surface.radius + field.amplitude()) * kPad;
        case scene::SurfaceKind::isosurface:
            return surface.bound == scene::BoundKind::ball ? surface.bound_size.x * kPad
                                                           : glm::length(surface.bound_size) * kPad;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace strata::render
