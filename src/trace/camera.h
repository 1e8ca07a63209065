// A pinhole camera: right-handed world, screen u to the right and v down, in pixels of the whole frame.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "src/scene/scene.h"

namespace strata::trace {

struct CameraRay {
    glm::dvec3 direction;  // of unit length
    double pixel_angle;    // width of a pixel at unit distance along this ray, across the ray, at its narrowest
};

// Directions within the angle whose tangent is given of a direction of unit length.
struct CameraCone {
    glm::dvec3 direction;
    double tangent;  // infinite where there is no such cone
};

class Camera {
  public:
    // Looking straight along `up`, another axis is taken for up.
    Camera(const scene::Camera& camera, const scene::Film& film);

    const glm::dvec3& position() const { return position_; }

    // Along which depth is measured, of unit length.
    const glm::dvec3& view_axis() const { return forward_; }

    // Itself in other axes from the same origin: the columns of `axes`, of unit length and across each other.
    Camera turned(const glm::dmat3& axes) const {
        Camera camera = *this;
        camera.position_ = position_ * axes;
        camera.forward_ = forward_ * axes;
        camera.right_ = right_ * axes;
        camera.up_ = up_ * axes;
        return camera;
    }

    CameraRay ray(double u, double v) const {
        const glm::dvec3 along = toward(u, v);
        const double squared = glm::dot(along, along);
        const double inverse = 1.0 / squared;
        return {along * glm::sqrt(inverse), pixel_ * inverse};
    }

    // Where the ray through (u, v) meets the plane at unit depth, from its middle, right and up.
    glm::dvec2 on_plane(double u, double v) const {
        return {(u - 0.5 * width_) * pixel_, (0.5 * height_ - v) * pixel_};
    }

    // Where something in a direction is seen, of any length: the (u, v) whose ray leads there. Nothing for what is not
    // before the camera.
    std::optional<glm::dvec2> on_screen(const glm::dvec3& direction) const;

    // Around the rays through a square of the screen, given by its corner and side.
    CameraCone cone(double u, double v, double side) const;

  private:
    glm::dvec3 toward(double u, double v) const {
        return forward_ + right_ * ((u - 0.5 * width_) * pixel_) - up_ * ((v - 0.5 * height_) * pixel_);
    }

    glm::dvec3 position_, forward_, right_, up_;
    double width_, height_;
    double pixel_;  // side of a pixel at unit depth
};

}  // namespace strata::trace
