#include "src/trace/reference_tracer.h"

namespace strata::trace {

// With f > 0 at s, |grad f| <= L leaves (s, s + f/L) free of the surface. The ray lands delta further: if f > 0 there
// too, any stretch of f < 0 in between is shorter than delta; if not, the first root lies within delta.
Hit trace_reference(const Field& field, const Ray& ray) {
    Hit hit;
    const Interval inside = field.clip(ray.origin, ray.direction, ray.limit);
    double s = inside.begin;
    hit.s_outside = s;
    while (s < inside.end) {
        ++hit.steps;
        const double f = field.value(ray.origin + s * ray.direction, ray.noise_shift);
        hit.noise_evaluations += static_cast<std::uint32_t>(field.evaluations());
        if (f <= 0.0) {
            hit.state = HitState::hit;
            hit.on_bound = inside.enters_bound && hit.steps == 1;
            hit.s = s;
            break;
        }
        if (hit.steps >= ray.step_limit) {
            hit.state = HitState::unresolved;
            hit.s = s;
            break;
        }
        hit.s_outside = s + f / field.lipschitz();
        if (hit.s_outside >= inside.end) break;
        s = hit.s_outside + ray.delta0 + ray.delta_slope * s;
    }
    return hit;
}

void trace_reference(const Field& field, std::span<const Ray> rays, std::span<Hit> hits, TraceCounters& counters) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits[i] = trace_reference(field, rays[i]);
        counters.noise_evaluations += hits[i].noise_evaluations;
        counters.executed_lanes += hits[i].noise_evaluations;
        counters.steps += hits[i].steps;
    }
}

}  // namespace strata::trace
