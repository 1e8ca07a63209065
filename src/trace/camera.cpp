#include "src/trace/camera.h"

#include <cmath>

namespace strata::trace {

namespace {

// sin of the least angle between the view and `up` that still tells left from right.
constexpr double kLeastSine = 1e-6;

glm::dvec3 right_of(const glm::dvec3& forward, const glm::dvec3& up) {
    const glm::dvec3 right = glm::cross(forward, glm::normalize(up));
    if (glm::length(right) > kLeastSine) return glm::normalize(right);
    const glm::dvec3 size = glm::abs(forward);
    const glm::dvec3 other = size.z <= size.x && size.z <= size.y ? glm::dvec3(0.0, 0.0, 1.0)
                             : size.x <= size.y                   ? glm::dvec3(1.0, 0.0, 0.0)
                                                                  : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(forward, other));
}

}  // namespace

Camera::Camera(const scene::Camera& camera, const scene::Film& film)
    : position_(camera.position),
      forward_(glm::normalize(camera.look_at - camera.position)),
      right_(right_of(forward_, camera.up)),
      up_(glm::cross(right_, forward_)),
      width_(film.width),
      height_(film.height),
      pixel_(2.0 * std::tan(glm::radians(0.5 * camera.fov_deg)) / film.width) {}

}  // namespace strata::trace
