// Every kind of relief term alone, by rays of which many graze.
#include "tests/trace/relief_check.h"

namespace {

using namespace strata;
using namespace strata::trace_test;

constexpr std::size_t kRays = 12000;

// Two surfaces of each kind.
template <class Make>
void check_alone(const Make& make) {
    Random random(31);
    std::size_t rays = 0;
    for (int i = 0; i < 4; ++i) {
        scene::Surface surface;
        surface.relief = make(random);
        check_rays(surface, kRays / 4, random, rays);
    }
    CHECK(rays >= kRays);
}

std::vector<noise::ReliefTerm> lone(noise::ReliefNode node) { return {{"a", {}, std::move(node)}}; }

std::vector<noise::ReliefTerm> over_hills(Random& random, noise::ReliefNode node) {
    return {{"a", {}, noise::Fbm{random_octaves(random, 4, 1.0)}}, {"b", {"a"}, std::move(node)}};
}

std::vector<noise::ReliefTerm> of_two(Random& random, noise::ReliefNode node) {
    return {{"a", {}, noise::Fbm{random_octaves(random, 4, 1.0)}},
            {"b", {}, noise::Ridged{random_octaves(random, 3, 1.0), 0.1, 1.5}},
            {"c", {"a", "b"}, std::move(node)}};
}

}  // namespace

TEST_CASE("no ray passes over billows (12,000 rays)") {
    check_alone([](Random& random) {
        return lone(noise::Billow{random_octaves(random, 6, 1.0), log_uniform(random, 0.01, 0.4), 0.0});
    });
}
TEST_CASE("no ray passes over a hybrid multifractal (12,000 rays)") {
    check_alone([](Random& random) { return lone(noise::Hybrid{random_octaves(random, 6, 1.0), 2.0}); });
}
TEST_CASE("no ray passes over a height curve (12,000 rays)") {
    check_alone([](Random& random) { return over_hills(random, random_curve(random)); });
}
TEST_CASE("no ray passes over terraces (12,000 rays)") {
    check_alone([](Random& random) {
        return over_hills(random, noise::Terraces{log_uniform(random, 0.03, 0.4), 0.9});
    });
}
TEST_CASE("no ray passes over a product (12,000 rays)") {
    check_alone([](Random& random) { return of_two(random, noise::Product{}); });
}
TEST_CASE("no ray passes over a blend (12,000 rays)") {
    check_alone([](Random& random) { return of_two(random, noise::Blend{0.1, 0.1 + log_uniform(random, 0.05, 0.5)}); });
}
TEST_CASE("no ray passes over the higher of two (12,000 rays)") {
    check_alone([](Random& random) { return of_two(random, noise::Highest{log_uniform(random, 1e-3, 0.1)}); });
}
TEST_CASE("no ray passes over the lower of two (12,000 rays)") {
    check_alone([](Random& random) { return of_two(random, noise::Lowest{log_uniform(random, 1e-3, 0.1)}); });
}
TEST_CASE("no ray passes over a ramp (12,000 rays)") {
    check_alone([](Random& random) {
        return lone(noise::Ramp{uniform(random, -2.0, 2.0), uniform(random, -180.0, 180.0), -2.0, 4.0});
    });
}
TEST_CASE("no ray passes over a mound (12,000 rays)") {
    check_alone([](Random& random) {
        return lone(noise::Envelope{.x_size = 2.0, .z_size = 3.0, .least = 0.0, .lift = uniform(random, -2.0, 2.0)});
    });
}
TEST_CASE("no ray passes over dunes (12,000 rays)") {
    check_alone([](Random& random) { return lone(random_dunes(random)); });
}
TEST_CASE("no ray passes over craters (12,000 rays)") {
    check_alone([](Random& random) { return lone(random_craters(random)); });
}
TEST_CASE("no ray passes over random compositions of terms (48,000 rays)") {
    Random random(32);
    std::size_t rays = 0;
    for (int i = 0; i < 80; ++i) check_rays(random_composed_surface(random), 300, random, rays);
    for (int i = 0; i < 80; ++i) {
        scene::Surface surface;
        surface.relief = random_landform(random);
        check_rays(surface, 300, random, rays);
    }
    CHECK(rays >= 48000);
}
