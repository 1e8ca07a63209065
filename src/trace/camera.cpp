#include "src/trace/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/trace/rounding_pad.h"

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

// The rays end at c + e on the plane at unit depth, c the square's centre and |e| <= r across the view: the tangent of
// their angle to c is |c x e| / (c.c + c.e), at most |c| r / (c.c - |c across| r).
std::optional<glm::dvec2> Camera::on_screen(const glm::dvec3& direction) const {
    const double depth = glm::dot(direction, forward_);
    if (depth <= 0.0) return std::nullopt;
    const double side = depth * pixel_;
    return glm::dvec2(0.5 * width_ + glm::dot(direction, right_) / side,
                      0.5 * height_ - glm::dot(direction, up_) / side);
}

CameraCone Camera::cone(double u, double v, double side) const {
    const glm::dvec3 centre = toward(u + 0.5 * side, v + 0.5 * side);
    const double squared = glm::dot(centre, centre), length = std::sqrt(squared);
    const double reach = std::sqrt(0.5) * side * pixel_ * kRoundingPad;
    const double ahead = squared - std::sqrt(std::max(0.0, squared - 1.0)) * reach * kRoundingPad;
    const double tangent =
        ahead > 0.0 ? length * reach / ahead * kRoundingPad : std::numeric_limits<double>::infinity();
    return {centre / length, tangent};
}

}  // namespace strata::trace
