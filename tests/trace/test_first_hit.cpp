#include "noise/simd_target.h"
#include "tests/trace/first_hit_check.h"

using namespace strata;

TEST_CASE("no ray passes over more than delta of the surface or reports a hit without one (2,000 rays a scene)") {
    trace_test::check_surfaces(20, 2000);
}

TEST_CASE("both promises hold while noise drifts through the surface, for both tracers") {
    trace_test::check_drifting_surfaces(16, 1000);
}

TEST_CASE("both promises hold on every SIMD target") {
    const std::vector<std::string> targets = noise::simd_targets();
    for (const std::string& target : targets) {
        CAPTURE(target);
        REQUIRE(noise::pin_simd_target(target));
        trace_test::check_surfaces(8, 500);
        trace_test::check_drifting_surfaces(4, 300);
    }
    noise::pin_simd_target(targets.front());
}
