// Shadow rays leave from the last point known to be outside: no acne, and shadows where an oracle has them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/integrate/surface_image.h"
#include "src/trace/shadow_ray.h"
#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::trace_test;
using trace::Hit;
using trace::HitState;
using trace::Ray;

namespace {

Hit trace_one(const trace::FastTracer& tracer, const Ray& ray) {
    Hit hit;
    trace::TraceCounters counters;
    tracer.trace({&ray, 1}, {&hit, 1}, counters);
    return hit;
}

}  // namespace

TEST_CASE("smooth planes and spheres are lit wherever they face the sun, down to grazing light") {
    Random random(61);
    int lit = 0, in_shadow = 0, grazing = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const bool plane = trial % 2 == 0;
        scene::Surface surface = surface_of(plane ? solid::kKind<solid::DisplacedPlane> : solid::kKind<solid::Sphere>);
        surface.amplitude = 0.0;
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        Ray ray{.origin = log_uniform(random, 5.5, 1e4) * unit_vector(random),
                .limit = 1e6,
                .delta_slope = log_uniform(random, 1e-7, 1e-3)};
        if (plane) ray.origin.y = log_uniform(random, 1e-3, 1e3);
        const glm::dvec3 target = plane ? 10.0 * unit_vector(random) * glm::dvec3(1, 0, 1) : 5.0 * unit_vector(random);
        ray.direction = glm::normalize(target - ray.origin);
        const Hit hit = trace_one(tracer, ray);
        // A sphere may be passed over where delta spans it.
        if (plane) REQUIRE(hit.state == HitState::hit);
        if (hit.state != HitState::hit) continue;
        const glm::dvec3 x = ray.origin + hit.s * ray.direction;
        const glm::dvec3 normal = field.base_gradient(x);
        glm::dvec3 sun = unit_vector(random);
        if (trial % 4 < 2) sun = glm::normalize(glm::cross(normal, sun)) + log_uniform(random, 1e-9, 1e-2) * normal;
        sun = glm::normalize(sun);
        // On a sphere the light turns by delta / radius from the last point outside to the hit, so that the terminator
        // moves by as much.
        const double turn = plane ? 0.0 : (hit.s - hit.s_outside) / surface.shape<solid::Sphere>().radius;
        if (glm::dot(normal, sun) <= turn) continue;
        ++lit;
        grazing += glm::dot(normal, sun) < 1e-2;
        in_shadow += trace_one(tracer, trace::shadow_ray(ray, hit, normal, sun)).state != HitState::miss;
    }
    MESSAGE(lit << " points that face the sun, " << grazing << " in grazing light; in shadow: " << in_shadow);
    CHECK(in_shadow == 0);
    CHECK(grazing > 3000);
}

// The truth: from the first root of f along the ray, moved outside by delta along the normal, a walk towards the sun by
// what the oracle proves free, or a hundredth of delta where it proves nothing.
TEST_CASE("on noise surfaces few points are lit or shadowed against the oracle") {
    Random random(62);
    for (const solid::KindRow& row : solid::all_solids()) {
        scene::Surface surface = surface_of(row.kind);
        surface.octaves = 6;
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        const oracle::FieldOracle expected(shape_of(surface));
        const double pixel_angle = 1e-3;
        const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 0.5, -0.3));
        int points = 0, false_shadow = 0, false_light = 0, shadowed = 0;
        for (const Ray& ray : RayFamilies(field, tracer, pixel_angle).make(random, 1600)) {
            const Hit hit = trace_one(tracer, ray);
            if (hit.state != HitState::hit || hit.s == 0.0 || hit.on_bound) continue;
            const glm::dvec3 x = ray.origin + hit.s * ray.direction;
            const glm::dvec3 normal = glm::normalize(field.gradient(x));
            if (glm::dot(normal, sun) <= 0.0) continue;
            const Ray to_sun = trace::shadow_ray(ray, hit, normal, sun);
            const bool claimed = trace_one(tracer, to_sun).state != HitState::miss;
            const double delta = ray.delta_slope * hit.s;
            const glm::dvec3 from = x + delta * normal;
            const oracle::Vec direction{sun.x, sun.y, sun.z};
            const oracle::Span span = oracle::clip(expected.shape(), {from.x, from.y, from.z}, direction, to_sun.limit);
            bool blocked = false;
            for (double s = std::max(span.begin, 0.0); s <= span.end && !blocked;) {
                const glm::dvec3 p = from + s * sun;
                if (field.base(p) > field.amplitude()) break;
                const oracle::Probe probe = expected.probe({p.x, p.y, p.z}, direction);
                blocked = probe.f < 0.0;
                s += std::max({probe.clear, 0.01 * delta, 1e-9});
            }
            ++points;
            shadowed += blocked;
            false_shadow += claimed && !blocked;
            false_light += !claimed && blocked;
        }
        MESSAGE(row.name << ": " << points << " points face the sun, " << shadowed << " in shadow; in shadow "
                         << "against the oracle " << false_shadow << ", lit against it " << false_light);
        CHECK(points > 100);
        // What is left are rims and grazing light, where delta itself decides.
        CHECK((false_shadow + false_light) * 100 <= 5 * points);
    }
}

TEST_CASE("pictures of smooth planes and spheres, near and far, are the same with and without shadows") {
    for (const solid::Kind kind :
         {solid::kKind<solid::HeightField>, solid::kKind<solid::Sphere>, solid::kKind<solid::LevelSet>}) {
        for (const double distance : {3.0, 100.0, 3e4}) {
            scene::Scene scene;
            scene.film = {.width = 60, .height = 40};
            scene.surface.kind = kind;
            scene.surface.amplitude = 0.0;
            scene.surface.shape<solid::Sphere>().radius = 1.0;
            scene.surface.shape<solid::LevelSet>().threshold = -1.0;
            scene.camera.far = 1e6;
            scene.camera.position = distance * glm::normalize(glm::dvec3(0.1, 0.07, -1.0));
            scene.camera.look_at = glm::dvec3(0.0);
            scene.camera.fov_deg = 120.0 / distance;
            std::vector<double> u, v, t;
            for (int i = 0; i < 2400; ++i) {
                u.push_back(i % 60 + 0.5);
                v.push_back(i / 60 + 0.5);
                t.push_back(0.0);
            }
            std::vector<glm::vec3> shadowed(u.size()), lit(u.size());
            integrate::Counters counters, unused;
            integrate::SurfaceImage(scene, integrate::Tracer::fast).evaluate({u, v, t}, shadowed, counters);
            scene.sun.shadows = false;
            integrate::SurfaceImage(scene, integrate::Tracer::fast).evaluate({u, v, t}, lit, unused);
            int darker = 0;
            for (std::size_t i = 0; i < lit.size(); ++i) darker += shadowed[i] != lit[i];
            CAPTURE(distance);
            CAPTURE(static_cast<int>(kind));
            CHECK(darker == 0);
            CHECK(counters.hits > 400);
            // A convex bound sees the sun wherever it faces it, without a ray.
            CHECK((counters.shadow_rays > 0) == (kind != solid::kKind<solid::LevelSet>));
        }
    }
}
