// The fast tracer: packets of rays on the widest SIMD target, guaranteed like the reference tracer but with a bound per
// octave instead of one global Lipschitz constant.
//
// At a point of the ray each octave has three upper bounds of a n over the next stretch s:
//   amplitude  a M,   Lipschitz  a (v + G w s),   Taylor  a (v + v' w s + H (w s)^2 / 2),
// with v, v' the octave's value and slope here. For any choice of one bound an octave, base(s) minus their sum is a
// quadratic that under-estimates f, so its first root is a safe step. Octaves are chosen by a hinted step length, the
// quadratic is solved, and both once more at the root. Octaves too fine for the step are not evaluated at all; where
// the sign of f is in doubt more are, until it is certain whatever the rest; where float cannot tell it the reference
// path decides in double.
//
// In a window (window.h) its polynomial stands for the octaves, and its error is part of the bound.
//
// A ray may land further than its safe step (over-relaxation: B. Keinert et al., "Enhanced Sphere Tracing", 2014): the
// same bounds, taken backwards from there, then have to cover the stretch in between, else the ray goes back.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "src/trace/field.h"
#include "src/trace/ray.h"
#include "src/trace/relief_plan.h"
#include "src/trace/trace_plan.h"

namespace strata::trace {

class FastTracer {
  public:
    explicit FastTracer(const Field& field) : field_(field) {}

    // A ray's hit depends on that ray alone, whatever its neighbours in the batch.
    void trace(std::span<const Ray> rays, std::span<Hit> hits, TraceCounters& counters) const;

    // Gradients of f (before the intersection with a bound) from every octave. noise_shift: of each point, or empty
    // where nothing drifts.
    void gradients(std::span<const glm::dvec3> x, std::span<const glm::dvec3> noise_shift,
                   std::span<glm::vec3> gradient, TraceCounters& counters) const;
    void gradients(std::span<const glm::dvec3> x, std::span<glm::vec3> gradient, TraceCounters& counters) const {
        gradients(x, {}, gradient, counters);
    }

    // Gradients of f near hits, at x: the octaves that the hits' own lack are added there.
    void gradients(std::span<const Hit> hits, std::span<const glm::dvec3> x, std::span<const glm::dvec3> noise_shift,
                   std::span<glm::vec3> gradient, TraceCounters& counters) const;

  private:
    const Field& field_;
};

}  // namespace strata::trace
