#include "tests/trace/first_hit_check.h"

TEST_CASE("no ray passes over more than delta of the surface or reports a hit without one (12,000 rays a scene)") {
    strata::trace_test::check_surfaces(50, 12000);
}

TEST_CASE("both promises hold while noise drifts through the surface, for both tracers (12,000 rays a scene)") {
    strata::trace_test::check_drifting_surfaces(16, 12000);
}
