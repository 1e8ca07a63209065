#include "src/trace/placement.h"

#include <algorithm>
#include <cmath>

namespace strata::trace {

namespace {

// Rodrigues' formula; exact for multiples of 90 degrees about an axis of the frame.
glm::dmat3 rotation_about(const glm::dvec3& unit_axis, double degrees) {
    const double turn = std::remainder(degrees, 360.0);
    double sine = std::sin(glm::radians(turn)), cosine = std::cos(glm::radians(turn));
    if (std::remainder(turn, 90.0) == 0.0) {
        sine = std::round(sine);
        cosine = std::round(cosine);
    }
    const glm::dvec3 a = unit_axis;
    const glm::dmat3 cross(0.0, a.z, -a.y, -a.z, 0.0, a.x, a.y, -a.x, 0.0);
    return cosine * glm::dmat3(1.0) + sine * cross + (1.0 - cosine) * glm::outerProduct(a, a);
}

glm::dmat3 euler_rotation(const glm::dvec3& degrees) {
    return rotation_about({0.0, 0.0, 1.0}, degrees.z) * rotation_about({0.0, 1.0, 0.0}, degrees.y) *
           rotation_about({1.0, 0.0, 0.0}, degrees.x);
}

}  // namespace

Placement::Placement(const scene::Surface& surface)
    : origin_(surface.origin),
      rotation_(euler_rotation(surface.rotation_deg)),
      spin_axis_(glm::normalize(surface.spin_axis)),
      spin_rate_(surface.spin_deg_per_s),
      scale_(surface.scale) {}

glm::dmat3 Placement::orientation(double t) const {
    if (!moves()) return rotation_;
    return rotation_about(spin_axis_, spin_rate_ * t) * rotation_;
}

Ray Placement::to_local(const glm::dmat3& orientation, const Ray& world, const glm::dvec3& noise_shift) const {
    Ray local;
    local.origin = point_to_local(orientation, world.origin);
    local.direction = glm::normalize(direction_to_local(orientation, world.direction));
    local.noise_shift = noise_shift;
    local.limit = world.limit / scale_;
    const double size = glm::length(local.origin) + glm::length(noise_shift);
    local.delta0 = std::max(world.delta0 / scale_, kLeastDelta * size);
    local.delta_slope = std::max(world.delta_slope, kLeastDelta);
    local.step_limit = world.step_limit;
    return local;
}

}  // namespace strata::trace
