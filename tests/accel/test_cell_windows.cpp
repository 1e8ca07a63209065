// Windows of screen cells: rays that pass through them keep both promises, and what each finds is its own.
#include "src/accel/cell_windows.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "noise/bounds.h"
#include "tests/accel/window_cases.h"
#include "tests/trace/fast_tracer_cases.h"

using namespace strata;
using namespace strata::accel;
using namespace strata::accel_test;
using namespace strata::trace_test;
using trace::Hit;
using trace::Ray;

TEST_CASE("a window holds for the rays of its cell from where it begins to where it ends") {
    Random random(20061122);
    std::size_t windows = 0;
    double greatest = 0.0;
    for (int i = 0; i < 48; ++i) {
        const Case c(smooth_surface(random, i), random, 200);
        const ConesOfRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
        for (std::size_t k = 0; k < with.rays.size(); ++k) {
            for (const trace::Window* w = with.groups[k].window; w != nullptr; w = w->after(), ++windows) {
                if (w->after() != nullptr) CHECK(w->after()->from <= w->to);
                for (const double share : {0.0, 1.0, uniform(random, 0.0, 1.0)}) {
                    const double s = w->from + share * (w->to - w->from);
                    greatest = std::max(greatest, error_share(c.field, *w, with.rays[k], s));
                }
            }
        }
    }
    MESSAGE(windows << " windows, greatest error " << greatest << " of its bound");
    CHECK(windows > 5000);
    CHECK(greatest < 1.0);
    CHECK(greatest > 0.1);
}

TEST_CASE(
    "rays settled by windows pass over no more than delta of the surface and report no hit without one, on every "
    "target") {
    on_every_target([](const std::string& target) {
        Random random(20061119);
        std::size_t rays = 0, windowed = 0, settled = 0, hit = 0;
        double thickest = 0.0;
        for (int i = 0; i < (target == kTargets.front() ? 96 : 16); ++i) {
            const Case c(smooth_surface(random, i), random, 500);
            CAPTURE(c.surface.seed);
            const ConesOfRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
            const TracedByWindows traced(c, with.rays, with.groups);
            const Judgement found = judge(c.surface, with.rays, traced.hits, c.families.times());
            CHECK(found.missed == 0);
            CHECK(found.unfounded == 0);
            CHECK(found.unresolved == 0);
            thickest = std::max(thickest, found.thickest);
            const std::uint64_t looked_up = traced.counters.noise_evaluations + traced.counters.left_out.total();
            CHECK(looked_up % c.field.octaves().size() == 0);
            rays += found.rays;
            for (std::size_t k = 0; k < with.rays.size(); ++k) {
                if (with.groups[k].window == nullptr) continue;
                ++windowed;
                settled += traced.settled[k];
                hit += traced.settled[k] && traced.hits[k].state == trace::HitState::hit;
            }
        }
        MESSAGE(target << ": " << rays << " rays, " << windowed << " with windows, " << settled
                       << " of them settled, of which " << hit << " hit; thickest stretch passed over " << thickest
                       << " delta (bound 1)");
        CHECK(windowed * 2 > rays);
        CHECK(hit * 5 > windowed);
    });
}

TEST_CASE("a bracket has f > 0 before it and a point with f <= 0 at its inner end, on every target") {
    on_every_target([](const std::string& target) {
        Random random(20061124);
        std::size_t brackets = 0, misses = 0;
        double greatest = -1.0, least = 1.0;  // of f over the rounding of its evaluation in double
        for (int i = 0; i < (target == kTargets.front() ? 48 : 12); ++i) {
            const Case c(smooth_surface(random, i), random, 400);
            CAPTURE(c.surface.seed);
            const ConesOfRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
            std::vector<trace::Bracket> found(with.rays.size());
            const trace::Bracketer bracketer(c.field);
            for (std::size_t k = 0; k < found.size(); ++k) {
                if (with.groups[k].window == nullptr) continue;
                const Ray& ray = with.rays[k];
                bracketer.bracket(with.rays, with.groups[k], found);
                const auto f = [&](double s) { return c.field.value(ray.origin + s * ray.direction, ray.noise_shift); };
                const trace::Interval inside = c.field.clip(ray.origin, ray.direction, ray.limit);
                const double begin = std::max(inside.begin, ray.start);
                const double rounding = 1e-12 * (1.0 + glm::length(ray.origin) + glm::length(ray.noise_shift));
                for (int j = 0; j < 8; ++j) {
                    const double s = std::lerp(begin, found[k].outside, j < 2 ? 1.0 : uniform(random, 0.0, 1.0));
                    if (s > begin && s < std::min(found[k].outside, inside.end)) CHECK(f(s) > -rounding);
                }
                misses += found[k].state == trace::BracketState::miss;
                if (found[k].state != trace::BracketState::bracket) continue;
                ++brackets;
                CHECK(found[k].outside <= found[k].guess);
                CHECK(found[k].guess <= found[k].inside);
                const double inner = f(found[k].inside);
                CHECK(inner <= rounding);
                greatest = std::max(greatest, inner);
                least = std::min(least, inner);
            }
        }
        MESSAGE(target << ": " << brackets << " brackets, " << misses << " misses; f at their inner ends from " << least
                       << " to " << greatest);
        CHECK(brackets > 500);
    });
}

TEST_CASE("what a ray finds does not depend on the rays that share its windows, nor on others of the batch") {
    Random random(20061120);
    std::size_t settled = 0;
    for (int i = 0; i < 12; ++i) {
        const Case c(smooth_surface(random, i), random, 400);
        ConesOfRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
        // All rays from one eye through the cone of one of them, now and then without windows.
        std::vector<Ray> rays;
        std::vector<trace::WindowedRays> groups;
        for (std::size_t k = 0; k < with.rays.size(); k += 5) {
            const std::size_t first = rays.size(), count = 1 + random() % 40;
            for (std::size_t j = 0; j < count; ++j) {
                Ray ray = with.rays[k];
                const glm::dvec3 off = 1e-6 * uniform(random, 0.0, 1.0) * unit_vector(random);
                if (j > 0) ray.direction = glm::normalize(ray.direction + off);
                rays.push_back(ray);
            }
            groups.push_back({first, rays.size(), random() % 4 == 0 ? nullptr : with.groups[k].window});
        }
        const TracedByWindows together(c, rays, groups);
        for (const trace::WindowedRays& group : groups) {
            for (std::size_t k = group.first; k < group.last; ++k) {
                const trace::WindowedRays alone_group = {0, 1, group.window};
                const TracedByWindows alone(c, {rays[k]}, {&alone_group, 1});
                REQUIRE(same(together.hits[k], alone.hits[0]));
                REQUIRE(together.settled[k] == alone.settled[0]);
                settled += group.window != nullptr && together.settled[k];
            }
        }
    }
    CHECK(settled > 1000);
}

TEST_CASE("the gradient that a landing reports is the noise's, within delta of the hit") {
    Random random(20061121);
    std::size_t count = 0;
    double greatest = 0.0;
    for (int i = 0; i < 16; ++i) {
        const Case c(smooth_surface(random, i), random, 500);
        const ConesOfRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
        const TracedByWindows traced(c, with.rays, with.groups);
        double bend = 0.0;  // bound of how fast the gradient turns
        const noise::NoiseBounds& bounds = c.field.is_planar_noise() ? noise::kBounds2 : noise::kBounds3;
        for (const noise::Octave& o : c.field.octaves()) {
            bend += o.amplitude * o.frequency * o.frequency * bounds.second;
        }
        bend += 2.0 * trace::Bracketer::half_curvature(c.field);
        for (std::size_t k = 0; k < traced.hits.size(); ++k) {
            const Hit& hit = traced.hits[k];
            if (!traced.settled[k] || hit.state != trace::HitState::hit) continue;
            CHECK(hit.octaves == c.field.octaves().size());
            CHECK(hit.s - hit.s_outside <= delta(with.rays[k], hit.s));
            const glm::dvec3 x = with.rays[k].origin + hit.s * with.rays[k].direction;
            const double off = glm::distance(c.field.gradient(x, with.rays[k].noise_shift), glm::dvec3(hit.gradient));
            const double bound = bend * delta(with.rays[k], hit.s) + 1e-5 * c.field.lipschitz();
            greatest = std::max(greatest, off / bound);
            ++count;
        }
    }
    MESSAGE(count << " landings, greatest difference " << greatest << " of its bound");
    CHECK(greatest <= 1.0);
    CHECK(count > 1000);
}

TEST_CASE("a shadow ray owes nothing to how the ray that found its hit was settled") {
    Random random(20061123);
    std::size_t count = 0;
    for (int i = 0; i < 8; ++i) {
        const Case c(smooth_surface(random, i), random, 300);
        const ConesOfRays with(c.field, c.rays, c.hits, c.pixel_angle, random);
        const TracedByWindows traced(c, with.rays, with.groups);
        std::vector<Ray> shadows;
        std::vector<double> times;
        for (std::size_t k = 0; k < c.rays.size(); ++k) {
            if (traced.hits[k].state != trace::HitState::hit || !traced.settled[k]) continue;
            const glm::dvec3 x = c.rays[k].origin + traced.hits[k].s * c.rays[k].direction;
            const glm::dvec3 normal = glm::normalize(c.field.gradient(x, c.rays[k].noise_shift));
            const glm::dvec3 to_light = glm::normalize(normal + 0.99 * unit_vector(random));
            shadows.push_back(trace::shadow_ray(with.rays[k], traced.hits[k], normal, to_light));
            times.push_back(c.families.times()[k]);
        }
        const Traced found = trace_all(c.tracer, shadows);
        const Judgement judged = judge(c.surface, shadows, found.hits, times);
        CHECK(judged.missed == 0);
        CHECK(judged.unfounded == 0);
        count += shadows.size();
    }
    CHECK(count > 200);
}
