#include "src/accel/bounding_ball.h"

#include <limits>

#include "src/trace/rounding_pad.h"

namespace strata::accel {

double bounding_ball(const trace::Field& field) {
    const scene::Surface& surface = field.surface();
    switch (surface.kind) {
        case scene::SurfaceKind::terrain:
        case scene::SurfaceKind::hyperterrain:
            break;
        case scene::SurfaceKind::planet:
            return (surface.radius + field.amplitude()) * trace::kRoundingPad;
        case scene::SurfaceKind::isosurface:
            return surface.bound == scene::BoundKind::ball ? surface.bound_size.x * trace::kRoundingPad
                                                           : glm::length(surface.bound_size) * trace::kRoundingPad;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace strata::accel
