// Fields and rays at the ends of what a scene may hold: bounded work, finite answers, promises kept.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "src/trace/fast_tracer.h"
#include "src/trace/reference_tracer.h"
#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::trace_test;
using trace::Hit;
using trace::HitState;
using trace::Ray;

namespace {

struct Extreme {
    std::string name;
    int octaves;
    double gain, lacunarity, amplitude, frequency;
};

// Each within what scene::validate() lets pass for rays of length 50 near the origin.
const Extreme kExtremes[] = {
    {"32 octaves", 32, 0.5, 2.0, 0.6, 0.5},
    {"32 octaves of equal frequency", 32, 0.5, 1.0, 0.6, 0.5},
    {"gain 0", 8, 0.0, 2.0, 0.6, 0.5},
    {"gain 1, lacunarity 1", 8, 1.0, 1.0, 0.1, 0.5},
    {"gain 1, lacunarity 2", 6, 1.0, 2.0, 0.1, 0.5},
    {"lacunarity 10", 10, 0.1, 10.0, 0.6, 0.5},
    {"amplitude 0", 8, 0.5, 2.0, 0.0, 0.5},
    {"amplitude 1e6", 8, 0.5, 2.0, 1e6, 0.5},
    {"amplitude 1e6, frequency 1e-9", 8, 0.5, 2.0, 1e6, 1e-9},
    {"frequency 1e-9", 8, 0.5, 2.0, 0.6, 1e-9},
    {"frequency 1e9", 8, 0.5, 2.0, 0.6, 1e9},
    {"frequency 1e9, amplitude 1e-9", 8, 0.5, 2.0, 1e-9, 1e9},
};

scene::Surface surface_with(const Extreme& extreme, solid::Kind kind) {
    scene::Surface surface = surface_of(kind);
    surface.octaves = extreme.octaves;
    surface.gain = extreme.gain;
    surface.lacunarity = extreme.lacunarity;
    surface.amplitude = extreme.amplitude;
    surface.frequency = extreme.frequency;
    return surface;
}

}  // namespace

TEST_CASE("extreme fields: every ray ends within the step limit, with finite answers on the ray and finite gradients") {
    Random random(71);
    for (const Extreme& extreme : kExtremes) {
        std::uint32_t most_steps = 0;
        int unresolved = 0, hits = 0;
        for (const solid::Kind kind : support::all_kinds()) {
            const trace::Field field(surface_with(extreme, kind));
            const trace::FastTracer tracer(field);
            std::vector<Ray> rays;
            for (int i = 0; i < 24; ++i) {
                const double reach = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 8.0 : 1e7;
                Ray ray{.origin = reach * unit_vector(random), .direction = unit_vector(random), .limit = 50.0};
                if (i % 2 == 0) ray.origin.y = std::abs(ray.origin.y);
                if (reach > 1e6) {
                    if (extreme.frequency > 1.0 || extreme.octaves == 32 || extreme.lacunarity > 9.0) continue;
                    ray.limit = 2e7;
                    ray.direction = glm::normalize(2.0 * unit_vector(random) - ray.origin);
                }
                ray.delta_slope = 1e-4;
                rays.push_back(ray);
            }
            std::vector<Hit> hit(rays.size());
            trace::TraceCounters counters;
            tracer.trace(rays, hit, counters);
            std::vector<glm::dvec3> x;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                REQUIRE(std::isfinite(hit[i].s));
                REQUIRE(hit[i].s_outside <= hit[i].s);
                REQUIRE(hit[i].steps <= trace::kStepLimit);
                most_steps = std::max(most_steps, hit[i].steps);
                unresolved += hit[i].state == HitState::unresolved;
                if (hit[i].state != HitState::hit) continue;
                ++hits;
                REQUIRE(hit[i].s >= 0.0);
                REQUIRE(hit[i].s <= rays[i].limit);
                x.push_back(rays[i].origin + hit[i].s * rays[i].direction);
            }
            std::vector<glm::vec3> gradient(x.size());
            tracer.gradients(x, gradient, counters);
            for (const glm::vec3& g : gradient) {
                REQUIRE(std::isfinite(g.x + g.y + g.z));
            }
        }
        MESSAGE(extreme.name << ": " << hits << " hits, most steps of a ray " << most_steps << ", unresolved "
                             << unresolved);
        CHECK(unresolved == 0);
    }
}

TEST_CASE("fields of the extremes that the oracle can follow keep the tracer's promises") {
    Random random(72);
    for (const Extreme& extreme : kExtremes) {
        if (extreme.frequency > 1.0 || extreme.octaves == 32) continue;
        for (const solid::Kind kind : support::all_kinds()) {
            const scene::Surface surface = surface_with(extreme, kind);
            const trace::Field field(surface);
            const trace::FastTracer tracer(field);
            std::vector<Ray> rays;
            for (int i = 0; i < 40; ++i) {
                glm::dvec3 origin = uniform(random, 0.1, 12.0) * unit_vector(random);
                if (i % 2 == 0) origin.y = std::abs(origin.y);
                rays.push_back(
                    {.origin = origin, .direction = unit_vector(random), .limit = 10.0, .delta_slope = 1e-3});
            }
            std::vector<Hit> hits(rays.size());
            trace::TraceCounters counters;
            tracer.trace(rays, hits, counters);
            const Judgement found = judge(surface, rays, hits);
            CAPTURE(extreme.name);
            CAPTURE(solid::row_of(kind).name);
            CHECK(found.missed == 0);
            CHECK(found.unfounded == 0);
        }
    }
}

TEST_CASE("a ray that starts on the surface gets away, whichever side of it rounding has put the start") {
    Random random(73);
    std::uint32_t most_steps = 0;
    int left = 0;
    for (const solid::Kind kind : support::all_kinds()) {
        const scene::Surface surface = surface_of(kind);
        const trace::Field field(surface);
        const trace::FastTracer tracer(field);
        for (int trial = 0; trial < 200; ++trial) {
            // Bisect f along a segment that crosses the surface until its ends are neighbours.
            glm::dvec3 outside, inside;
            const auto sample = [&] {
                glm::dvec3 x = 1.9 * unit_vector(random);
                if (!solid::row_of(kind).is_level) x = uniform(random, 4.0, 6.0) * unit_vector(random);
                return x;
            };
            do outside = sample();
            while (field.value(outside) <= 0.0);
            do inside = sample();
            while (field.value(inside) > 0.0);
            for (int i = 0; i < 70; ++i) {
                const glm::dvec3 middle = 0.5 * (outside + inside);
                (field.value(middle) > 0.0 ? outside : inside) = middle;
            }
            const glm::dvec3 normal = glm::normalize(field.gradient(outside));
            const glm::dvec3 tangent = glm::normalize(glm::cross(normal, unit_vector(random)));
            for (const glm::dvec3& direction : {normal, tangent, -normal}) {
                const Ray ray{.origin = outside, .direction = direction, .limit = 20.0, .delta_slope = 1e-4};
                Hit hit;
                trace::TraceCounters counters;
                tracer.trace({&ray, 1}, {&hit, 1}, counters);
                REQUIRE(hit.state != HitState::unresolved);
                most_steps = std::max(most_steps, hit.steps);
                left += direction == normal && (hit.state == HitState::miss || hit.s > 1e-3);
                if (direction == -normal) REQUIRE((hit.state == HitState::hit && hit.s < 1e-6));
            }
        }
    }
    MESSAGE("most steps of a ray that starts on the surface " << most_steps << "; " << left << " of 800 got away");
    CHECK(left > 780);
    CHECK(most_steps < 20000);
}
