// Where a surface stands in the world: x_world = origin + spin(t) * rotation * (scale * x_local).
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "src/scene/scene.h"
#include "src/trace/ray.h"

namespace strata::trace {

class Placement {
  public:
    explicit Placement(const scene::Surface& surface);

    bool moves() const { return spin_rate_ != 0.0; }
    double scale() const { return scale_; }

    // Without the spin: what the sky, which does not turn with the surface, is laid out by.
    const glm::dmat3& resting_orientation() const { return rotation_; }

    // Orientation at time t in seconds: the columns are the local axes in the world.
    glm::dmat3 orientation(double t) const;

    glm::dvec3 point_to_local(const glm::dmat3& orientation, const glm::dvec3& x) const {
        return ((x - origin_) * orientation) / scale_;
    }
    glm::dvec3 point_to_world(const glm::dmat3& orientation, const glm::dvec3& x) const {
        return origin_ + orientation * (scale_ * x);
    }
    // The transpose of a rotation is its inverse.
    static glm::dvec3 direction_to_local(const glm::dmat3& orientation, const glm::dvec3& d) { return d * orientation; }

    // A ray of the world, with limit and deltas in world units, in the surface's coordinates: s_local = s_world /
    // scale. noise_shift is the field's at the ray's time. Deltas are raised to what double can tell along the ray, for
    // the ray and for where its noise is evaluated.
    Ray to_local(const glm::dmat3& orientation, const Ray& world,
                 const glm::dvec3& noise_shift = glm::dvec3(0.0)) const;

    // What to_local gives for another ray from the same point at the same time: `local` but for the direction, which is
    // given in the surface's coordinates.
    static void aim(Ray& local, const glm::dvec3& direction, double world_delta_slope) {
        local.direction = direction;
        local.delta_slope = std::max(world_delta_slope, kLeastDelta);
    }

  private:
    // Positions along a ray are rounded by 2^-52 of their size or less: a tolerance finer than a few of that is none.
    static constexpr double kLeastDelta = 0x1p-50;

    glm::dvec3 origin_;
    glm::dmat3 rotation_;
    glm::dvec3 spin_axis_;
    double spin_rate_;  // degrees a second
    double scale_;
};

}  // namespace strata::trace
