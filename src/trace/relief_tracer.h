// Tracing of fields whose relief is composed (noise/relief/relief.h), as fast_tracer.h and beam_tracer.h do with a lone
// fBm: what those two call for such fields.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "src/trace/beam.h"
#include "src/trace/field.h"
#include "src/trace/ray.h"
#include "src/trace/relief_plan.h"
#include "src/trace/trace_plan.h"

namespace strata::trace {

// The promises of FastTracer::trace.
void trace_relief(const Field& field, const TracePlan& constants, const ReliefPlan& plan, std::span<const Ray> rays,
                  std::span<Hit> hits, TraceCounters& counters);

// The promises of BeamTracer::trace.
void trace_relief_beams(const Field& field, const ReliefPlan& plan, std::span<const Beam> beams,
                        std::span<BeamEnd> ends, TraceCounters& counters);

// Gradients of f before the intersection with a bound, at points x.
void relief_gradients(const Field& field, const ReliefPlan& plan, std::span<const glm::dvec3> x,
                      std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient, TraceCounters& counters);

}  // namespace strata::trace
