// Plain sphere tracing (Hart 1996) in scalar double with the global Lipschitz constant and every octave at each step:
// obviously right, and what the fast tracer's results and cost are held against.
#pragma once

#include <span>

#include "src/trace/field.h"
#include "src/trace/ray.h"

namespace strata::trace {

Hit trace_reference(const Field& field, const Ray& ray);

void trace_reference(const Field& field, std::span<const Ray> rays, std::span<Hit> hits, TraceCounters& counters);

}  // namespace strata::trace
