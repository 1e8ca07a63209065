// A surface in its own coordinates: f(x) = base(x) - sum_k a_k n_k(w_k (x + shift) + o_k), solid where f <= 0. The
// shift is that of a drifting noise at some time, else zero.
//
//   terrain       base = y           noise in 2-D at (x, z)
//   hyperterrain  base = y           noise in 3-D
//   planet        base = |x| - R     noise in 3-D
//   isosurface    base = threshold   noise in 3-D, intersected with a ball or box about the origin
//
// In place of the sum there may be a relief composed of terms (noise/relief/relief.h), read at x + shift.
//
// This is the reference path: scalar double, by the definition.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "noise/fbm.h"
#include "src/scene/scene.h"

namespace strata::trace {

// A stretch [begin, end) of a ray; empty when begin >= end. enters_bound: begin lies on the isosurface's bound.
struct Interval {
    double begin = 0.0;
    double end = 0.0;
    bool enters_bound = false;
};

class Field {
  public:
    explicit Field(const scene::Surface& surface);

    scene::SurfaceKind kind() const { return surface_.kind; }
    const scene::Surface& surface() const { return surface_; }
    bool is_planar_noise() const { return surface_.kind == scene::SurfaceKind::terrain; }

    // What stands for the sum, or null.
    const noise::Relief* relief() const { return relief_.get(); }

    // Noise evaluations at a point where nothing is left out.
    std::size_t evaluations() const { return relief_ ? relief_->evaluations() : octaves_.size(); }

    // Octaves that can change the sum in double, coarsest first. None where a relief stands for the sum.
    const std::vector<noise::Octave>& octaves() const { return octaves_; }

    // Upper bound of |sum_k a_k n_k|, or of the relief's size.
    double amplitude() const { return amplitude_; }

    // Upper bound of |grad f|.
    double lipschitz() const { return lipschitz_; }

    // Whether the noise moves through the surface, and that changes it.
    bool drifts() const { return drifts_; }

    // -drift * t, t in seconds; exactly zero without drift.
    glm::dvec3 noise_shift(double t) const { return drifts() ? -t * surface_.drift : glm::dvec3(0.0); }

    double base(const glm::dvec3& x) const;

    // a_k n_k(w_k (x + shift) + o_k).
    double octave(std::size_t k, const glm::dvec3& x, const glm::dvec3& shift = glm::dvec3(0.0)) const;

    // f before the intersection with a bound.
    double value(const glm::dvec3& x, const glm::dvec3& shift = glm::dvec3(0.0)) const;

    glm::dvec3 base_gradient(const glm::dvec3& x) const;

    // Gradient of value(), not normalised.
    glm::dvec3 gradient(const glm::dvec3& x, const glm::dvec3& shift = glm::dvec3(0.0)) const;

    // The part of the ray origin + s direction, s in [0, limit), outside of which f > 0. direction is of unit length.
    Interval clip(const glm::dvec3& origin, const glm::dvec3& direction, double limit) const {
        const bool is_slab = kind() == scene::SurfaceKind::terrain || kind() == scene::SurfaceKind::hyperterrain;
        return is_slab ? clip_slab(origin.y, direction.y, limit) : clip_bounded(origin, direction, limit);
    }

    // Outward normal of the isosurface's bound at a point of it.
    glm::dvec3 bound_normal(const glm::dvec3& x) const;

  private:
    // The slab's plane and the planet's shell are moved outwards by this fraction of the lengths involved, far above
    // the rounding of the roots in double. An isosurface's bound is a surface itself and stays where it is.
    static constexpr double kClipSlack = 1e-9;

    // Below the greatest height.
    Interval clip_slab(double height, double slope, double limit) const {
        const double padded = amplitude_ + kClipSlack * (amplitude_ + std::abs(height));
        if (height > padded) {
            if (slope >= 0.0) return {};
            return {std::min((padded - height) / slope, limit), limit};
        }
        // A ray that leaves a smooth plane from the plane itself still has its first point.
        constexpr double kLeast = std::numeric_limits<double>::min();
        return {0.0, slope > 0.0 ? std::min(limit, std::max((padded - height) / slope, kLeast)) : limit};
    }
    Interval clip_bounded(const glm::dvec3& origin, const glm::dvec3& direction, double limit) const;

    scene::Surface surface_;
    std::vector<noise::Octave> octaves_;
    std::shared_ptr<const noise::Relief> relief_;
    double amplitude_ = 0.0;
    double lipschitz_ = 1.0;
    bool drifts_ = false;
};

}  // namespace strata::trace
