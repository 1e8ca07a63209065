// A surface in its own coordinates: f(x) = base(x) - sum_k a_k n_k(w_k (x + shift) + o_k), solid where f <= 0. The
// shift is that of a drifting noise at some time, else zero.
//
//   terrain       base = y           noise in 2-D at (x, z)
//   hyperterrain  base = y           noise in 3-D
//   planet        base = |x| - R     noise in 3-D
//   isosurface    base = threshold   noise in 3-D, intersected with a ball or box about the origin
//
// This is the reference path: scalar double, by the definition.
#pragma once

#include <glm/glm.hpp>
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

    // Octaves that can change the sum in double, coarsest first.
    const std::vector<noise::Octave>& octaves() const { return octaves_; }

    // Upper bound of |sum_k a_k n_k|.
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
    Interval clip(const glm::dvec3& origin, const glm::dvec3& direction, double limit) const;

    // Outward normal of the isosurface's bound at a point of it.
    glm::dvec3 bound_normal(const glm::dvec3& x) const;

  private:
    scene::Surface surface_;
    std::vector<noise::Octave> octaves_;
    double amplitude_ = 0.0;
    double lipschitz_ = 1.0;
    bool drifts_ = false;
};

}  // namespace strata::trace
