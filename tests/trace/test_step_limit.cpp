// What no built-in scene should meet: a ray that is given up.
#include <doctest/doctest.h>

#include "src/trace/fast_tracer.h"
#include "src/trace/reference_tracer.h"

using namespace strata;

TEST_CASE("a ray that needs more steps than its limit is unresolved, by both tracers; one that needs as many is not") {
    scene::Surface surface;
    surface.kind = solid::kKind<solid::DisplacedPlane>;
    const trace::Field field(surface);
    const trace::FastTracer fast(field);
    trace::Ray ray{.origin = {0.3, 0.9, 0.1},
                   .direction = glm::normalize(glm::dvec3(0.0, -0.2, 1.0)),
                   .limit = 60.0,
                   .delta_slope = 1e-4};
    for (const bool use_fast : {true, false}) {
        const auto trace_ray = [&] {
            trace::Hit hit;
            trace::TraceCounters counters;
            if (use_fast) {
                fast.trace({&ray, 1}, {&hit, 1}, counters);
            } else {
                hit = trace::trace_reference(field, ray);
            }
            return hit;
        };
        ray.step_limit = trace::kStepLimit;
        const trace::Hit whole = trace_ray();
        REQUIRE(whole.state == trace::HitState::hit);
        REQUIRE(whole.steps > 3);
        ray.step_limit = whole.steps;
        CHECK(trace_ray().state == trace::HitState::hit);
        ray.step_limit = whole.steps - 1;
        const trace::Hit given_up = trace_ray();
        CHECK(given_up.state == trace::HitState::unresolved);
        CHECK(given_up.steps == whole.steps - 1);
    }
}
