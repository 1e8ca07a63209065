// Traces bundles of rays, a lane each, by the bounds per octave of fast_tracer.h taken over the bundle's width as well.
//
// At an axis point with radius r there, a point D = t d + e ahead (d the axis, e across it, |e| <= r + spread t) has
//   n(D) <= M,   n(D) <= v + G w |D|,   n(D) <= v + w (g.d t + g.e) + H w^2 |D|^2 / 2,
// and the terms w g.e of all octaves and of the base together are at most |(grad f) across| (r + spread t). So for any
// choice of one bound an octave, f >= a quadratic in t alone, whose first root is a safe step for the whole bundle.
#pragma once

#include <span>

#include "src/trace/beam.h"
#include "src/trace/field.h"
#include "src/trace/ray.h"
#include "src/trace/relief_plan.h"
#include "src/trace/trace_plan.h"

namespace strata::trace {

class BeamTracer {
  public:
    explicit BeamTracer(const Field& field) : field_(field) {}

    // A beam's end depends on that beam alone.
    void trace(std::span<const Beam> beams, std::span<BeamEnd> ends, TraceCounters& counters) const;

  private:
    const Field& field_;
};

}  // namespace strata::trace
