// A surface in its own coordinates: f(x) = base(x) - sum_k a_k n_k(w_k (x + shift) + o_k), solid where f <= 0. The
// shift is that of a drifting noise at some time, else zero.
//
// The base is a solid's (src/solid); the noise is 2-D, at x and z, or 3-D.
//
// In place of the sum there may be a relief composed of terms (noise/relief/relief.h), read at x + shift.
//
// This is the reference path: scalar double, by the definition.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "noise/fbm.h"
#include "src/scene/scene.h"
#include "src/solid/solid.h"

namespace strata::trace {

using solid::Interval;

struct TracePlan;
struct ReliefPlan;

class Field {
  public:
    explicit Field(const scene::Surface& surface);

    const scene::Surface& surface() const { return surface_; }
    const solid::Solid& solid() const { return solid_; }
    bool is_planar_noise() const { return is_planar_noise_; }

    // What stands for the sum, or null.
    const noise::Relief* relief() const { return relief_.get(); }

    // What the fast tracers prepare from the field: made once, and shared by them and by copies of the field.
    const TracePlan& plan() const { return *plan_; }

    // The same of a composed relief, or null.
    const ReliefPlan* relief_plan() const { return relief_plan_.get(); }

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

    double base(const glm::dvec3& x) const {
        return solid::visit([&](const auto& s) { return s.value(x); }, solid_);
    }

    // a_k n_k(w_k (x + shift) + o_k).
    double octave(std::size_t k, const glm::dvec3& x, const glm::dvec3& shift = glm::dvec3(0.0)) const;

    // f before the intersection with a bound.
    double value(const glm::dvec3& x, const glm::dvec3& shift = glm::dvec3(0.0)) const;

    glm::dvec3 base_gradient(const glm::dvec3& x) const {
        return solid::visit([&](const auto& s) { return s.gradient(x); }, solid_);
    }

    // What materials call height, and up, of unit length.
    double height(const glm::dvec3& x) const {
        return solid::visit([&](const auto& s) { return s.height(x); }, solid_);
    }
    glm::dvec3 up(const glm::dvec3& x) const {
        return solid::visit([&](const auto& s) { return s.up(x); }, solid_);
    }

    // What holds all that is solid.
    solid::Extent extent() const {
        return solid::visit([&](const auto& s) { return s.extent(amplitude_); }, solid_);
    }

    // Gradient of value(), not normalised.
    glm::dvec3 gradient(const glm::dvec3& x, const glm::dvec3& shift = glm::dvec3(0.0)) const;

    // The part of the ray origin + s direction, s in [0, limit), outside of which f > 0. direction is of unit length.
    Interval clip(const glm::dvec3& origin, const glm::dvec3& direction, double limit) const {
        return solid::visit([&](const auto& s) { return s.clip(origin, direction, limit, amplitude_); }, solid_);
    }

    // Outward normal of the bound of a solid that has one, at a point of it.
    glm::dvec3 bound_normal(const glm::dvec3& x) const;

  private:
    scene::Surface surface_;
    solid::Solid solid_;
    bool is_planar_noise_;
    std::vector<noise::Octave> octaves_;
    std::shared_ptr<const noise::Relief> relief_;
    double amplitude_ = 0.0;
    double lipschitz_ = 1.0;
    bool drifts_ = false;
    std::shared_ptr<const TracePlan> plan_;
    std::shared_ptr<const ReliefPlan> relief_plan_;
};

}  // namespace strata::trace
