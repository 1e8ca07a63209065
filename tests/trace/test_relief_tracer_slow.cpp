// Many rays through each type of relief term and through random landforms.
#include "tests/trace/relief_check.h"

using namespace strata;
using namespace strata::trace_test;

namespace {

constexpr solid::Kind kGrounds[] = {solid::kKind<solid::HeightField>, solid::kKind<solid::DisplacedPlane>};

}  // namespace

TEST_CASE("no ray of many passes over ridged reliefs") {
    Random random(31);
    std::size_t rays = 0;
    for (int i = 0; i < 16; ++i) {
        noise::Ridged ridged{random_octaves(random, 8, 1.0)};
        ridged.roundness = log_uniform(random, 0.01, 0.4);
        ridged.feedback = i % 4 == 0 ? 0.0 : uniform(random, 0.5, 3.0);
        check_rays(plain(kGrounds[i % 2], {{"ridges", {}, ridged}}), 3000, random, rays);
    }
    CHECK(rays >= 48'000);
}

TEST_CASE("no ray of many passes over warped reliefs") {
    Random random(32);
    std::size_t rays = 0;
    for (int i = 0; i < 16; ++i) {
        const noise::Warp warp{random_octaves(random, 2, 0.5)};
        check_rays(plain(kGrounds[i % 2], {random_leaf(random, "a"), {"bent", {"a"}, warp}}), 3000, random, rays);
    }
    CHECK(rays >= 48'000);
}

TEST_CASE("no ray of many passes over random compositions, at rest and drifting") {
    Random random(33);
    std::size_t rays = 0;
    for (int i = 0; i < 48; ++i) {
        scene::Surface surface = random_composed_surface(random);
        if (i % 3 == 0) surface.drift = log_uniform(random, 1e-3, 10.0) * unit_vector(random);
        check_rays(surface, 1000, random, rays);
    }
    CHECK(rays >= 48'000);
}

TEST_CASE("no ray passes over landforms with gullies of up to four octaves") {
    Random random(34);
    std::size_t rays = 0;
    for (int i = 0; i < 40; ++i) {
        scene::Surface surface;
        surface.relief = random_landform(random);
        check_rays(surface, 60, random, rays);
    }
    CHECK(rays >= 2'400);
}
