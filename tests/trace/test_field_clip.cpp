// The part of a ray in which the surface may be, and the bodies that isosurfaces are cut from.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "src/trace/field.h"
#include "tests/support/surfaces.h"
#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::trace_test;

namespace {

glm::dvec3 anywhere(Random& random, double reach) {
    return reach * glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
}

// How far x lies outside the isosurface's bound; negative inside.
double outside_bound(const scene::Surface& surface, const glm::dvec3& x) {
    const auto& set = surface.shape<solid::LevelSet>();
    if (set.bound == solid::LevelSet::Bound::ball) return glm::length(x) - set.bound_size.x;
    const glm::dvec3 beyond = glm::abs(x) - set.bound_size;
    return std::max({beyond.x, beyond.y, beyond.z});
}

// Rays that are hard on clipping: axis-parallel, in a face's plane, tangent, from inside, from far away.
trace::Ray clip_ray(Random& random, const trace::Field& field) {
    const scene::Surface& surface = field.surface();
    trace::Ray ray{.origin = anywhere(random, log_uniform(random, 1.0, 30.0)),
                   .direction = unit_vector(random),
                   .limit = log_uniform(random, 0.1, 100.0)};
    const auto axis = static_cast<int>(random() % 3);
    if (random() % 3 == 0) {
        ray.direction = glm::dvec3(0.0);
        ray.direction[axis] = random() % 2 == 0 ? 1.0 : -1.0;
    }
    switch (random() % 4) {
        case 0:
            ray.origin = anywhere(random, 0.5);
            break;
        case 1:  // grazing the ball, the shell or a face
            ray.origin = (solid::row_of(surface.kind).has_bound ? surface.shape<solid::LevelSet>().bound_size.x
                          : std::isfinite(field.extent().ball)  ? field.extent().ball
                                                                : 1.0) *
                         glm::normalize(glm::cross(ray.direction, unit_vector(random)));
            ray.origin -= uniform(random, 0.0, 20.0) * ray.direction;
            break;
        case 2:
            ray.origin[axis] = solid::row_of(surface.kind).has_bound ? surface.shape<solid::LevelSet>().bound_size[axis]
                                                                     : field.amplitude();
            if (random() % 2 == 0)
                ray.direction = glm::normalize(ray.direction * glm::dvec3(axis != 0, axis != 1, axis != 2) + 1e-9);
            break;
        default:
            break;
    }
    return ray;
}

}  // namespace

TEST_CASE("outside of clip()'s interval a ray meets nothing, and the interval lies on the ray") {
    Random random(16);
    int empty = 0, shortened = 0, entered = 0;
    for (int trial = 0; trial < 6000; ++trial) {
        scene::Surface surface = surface_of(support::any_kind(static_cast<std::uint64_t>(trial)));
        surface.shape<solid::LevelSet>().bound =
            random() % 2 == 0 ? solid::LevelSet::Bound::ball : solid::LevelSet::Bound::box;
        surface.amplitude = random() % 4 == 0 ? 0.0 : log_uniform(random, 1e-3, 2.0);
        const trace::Field field(surface);
        const oracle::FieldOracle expected(shape_of(surface));
        const trace::Ray ray = clip_ray(random, field);
        const trace::Interval inside = field.clip(ray.origin, ray.direction, ray.limit);
        const bool is_empty = !(inside.begin < inside.end);
        empty += is_empty;
        shortened += !is_empty && (inside.begin > 0.0 || inside.end < ray.limit);
        if (!is_empty) {
            REQUIRE(inside.begin >= 0.0);
            REQUIRE(inside.end <= ray.limit);
        }
        const double size = glm::length(ray.origin) + ray.limit;
        const auto is_clear = [&](double s) {
            const glm::dvec3 x = ray.origin + s * ray.direction;
            if (solid::row_of(surface.kind).has_bound && outside_bound(surface, x) > -1e-14 * size) return true;
            return expected.value(oracle::as_vec(x)) > 0.0;
        };
        CAPTURE(trial);
        const double begin = is_empty ? ray.limit : inside.begin;
        for (int i = 0; i < 12; ++i) {
            if (begin > 0.0) REQUIRE(is_clear(begin * (i == 0 ? 1.0 - 1e-12 : uniform(random, 0.0, 1.0))) == true);
            if (is_empty || inside.end >= ray.limit) continue;
            const double share = i == 0 ? 1e-12 : uniform(random, 0.0, 1.0);
            REQUIRE(is_clear(inside.end + share * (ray.limit - inside.end)) == true);
        }
        if (is_empty || !inside.enters_bound) continue;
        ++entered;
        REQUIRE(solid::row_of(surface.kind).has_bound);
        const glm::dvec3 at = ray.origin + inside.begin * ray.direction;
        REQUIRE(std::abs(outside_bound(surface, at)) < 1e-7 * size);
        const glm::dvec3 normal = field.bound_normal(at);
        REQUIRE(glm::dot(normal, ray.direction) < 1e-6);
        REQUIRE(outside_bound(surface, at + 1e-3 * normal) > 0.0);
    }
    MESSAGE(empty << " empty, " << shortened << " shortened, " << entered << " enter a bound, of 6000");
    CHECK(empty > 500);
    CHECK(shortened > 500);
    CHECK(entered > 50);
}
