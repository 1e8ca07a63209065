#include "tests/trace/first_hit_check.h"

TEST_CASE("no ray passes over more than delta of the surface or reports a hit without one (2,000 rays a scene)") {
    strata::trace_test::check_surfaces(20, 2000);
}
