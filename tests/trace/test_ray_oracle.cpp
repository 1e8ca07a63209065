// The oracle of ray_oracle.h itself: it passes correct reports and catches planted errors.
#include "tools/stability/oracles/ray_oracle.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/random.h"

namespace {

using namespace strata::oracle;
using strata::support::uniform;

// Solid in disjoint ascending stretches. f is the distance to the nearest end, bent by a factor in (0.6, 1.4); clear is
// too small by `looseness`, as a Lipschitz bound is.
struct Slabs {
    std::vector<Span> solids;
    double looseness = 1.0;

    Probe operator()(double t) const {
        double distance = INFINITY;
        bool inside = false;
        for (const Span& solid : solids) {
            distance = std::min({distance, std::abs(t - solid.begin), std::abs(t - solid.end)});
            inside = inside || (t >= solid.begin && t <= solid.end);
        }
        const double f = std::min(distance, 1e3) * (1.0 + 0.4 * std::sin(7.0 * t));
        return {inside ? -f : f, distance / looseness};
    }
};

struct Tolerance {
    double at_origin = 0.0;
    double slope = 0.0;

    double operator()(double t) const { return at_origin + slope * t; }
};

// Slabs 0.05 to 4 tolerances thick, but none within 1 % of a tolerance, with gaps of more than 3 tolerances.
Slabs random_slabs(std::mt19937_64& random, const Tolerance& delta, const Span& range, double thick_share) {
    Slabs slabs;
    slabs.looseness = std::exp2(uniform(random, 0.0, 6.0));
    double t = range.begin + uniform(random, 3.5, 400.0) * delta(range.begin);
    for (int i = 0; i < 12; ++i) {
        const bool thick = uniform(random, 0.0, 1.0) < thick_share;
        double thickness = (thick ? uniform(random, 1.01, 4.0) : uniform(random, 0.05, 0.99)) * delta(t);
        thickness /= 1.0 - delta.slope;  // a stretch is held against delta at its end
        if (t + 10.0 * thickness > range.end) break;
        slabs.solids.push_back({t, t + thickness});
        t += thickness + uniform(random, 3.5, 400.0) * delta(t + thickness);
    }
    return slabs;
}

bool is_thick(const Span& slab, const Tolerance& delta) { return slab.end - slab.begin > delta(slab.end); }

}  // namespace

TEST_CASE("reports on random slabs pass when right and are caught when wrong") {
    std::mt19937_64 random(1);
    const Span range{0.5, 60.0};
    int missed = 0, unfounded = 0, passed = 0, undecided = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const Tolerance delta{trial % 2 == 0 ? 1e-3 : 0.0, trial % 3 == 0 ? 0.0 : 2e-3};
        if (delta(1.0) == 0.0) continue;
        const Slabs slabs = random_slabs(random, delta, range, trial % 4 == 0 ? 0.0 : 0.3);
        const auto judge = [&](const Claim& claim) { return judge_ray(slabs, range, delta, claim); };
        const auto first = std::find_if(slabs.solids.begin(), slabs.solids.end(),
                                        [&](const Span& slab) { return is_thick(slab, delta); });
        CAPTURE(trial);

        // A miss.
        const Verdict miss = judge({false, 0.0});
        CHECK(miss.missed == (first != slabs.solids.end()));
        CHECK_FALSE(miss.unfounded);
        if (miss.missed) {
            CHECK(std::abs(miss.stretch.begin - first->begin) < 1e-9);
            CHECK(std::abs(miss.stretch.end - first->end) < 1e-9);
            ++missed;
        }

        for (auto slab = slabs.solids.begin(); slab != slabs.solids.end(); ++slab) {
            // Hits at, just before, just inside and just behind each slab are founded; they miss what came before.
            const double d = delta(slab->begin);
            for (const double t : {slab->begin, slab->begin - 0.98 * d, slab->begin + 0.9 * (slab->end - slab->begin),
                                   slab->end + 0.98 * d}) {
                const Verdict verdict = judge({true, t});
                CHECK_FALSE(verdict.unfounded);
                const bool too_late =
                    first != slabs.solids.end() && t > first->begin + 1.005 * delta(first->end) / (1.0 - delta.slope);
                const bool in_time = first == slabs.solids.end() || t < first->begin + 0.995 * delta(t);
                if (too_late) CHECK(verdict.missed);
                if (in_time) CHECK_FALSE(verdict.missed);
                passed += verdict.ok();
                undecided += verdict.undecided;
            }
            // Hits in the gap before it are not.
            const Verdict verdict = judge({true, slab->begin - 1.02 * delta(slab->begin)});
            CHECK(verdict.unfounded);
            unfounded += verdict.unfounded;
        }
    }
    MESSAGE(passed << " reports passed, " << missed << " missed slabs and " << unfounded << " unfounded hits caught");
    CHECK(passed > 1000);
    CHECK(missed > 300);
    CHECK(undecided == 0);
}

TEST_CASE("a ray that starts inside is a hit at its start, and slabs cut by its ends count for their part within") {
    const Tolerance delta{1e-3, 0.0};
    const Slabs slabs{{{-1.0, 2.0}, {5.0, 7.0}}, 2.0};
    CHECK(judge_ray(slabs, Span{0.0, 4.0}, delta, {true, 0.0}).ok());
    CHECK(judge_ray(slabs, Span{0.0, 4.0}, delta, {false, 0.0}).missed);
    CHECK(judge_ray(slabs, Span{0.0, 4.0}, delta, {true, 2.0}).missed);
    CHECK(judge_ray(slabs, Span{2.0 - 0.9e-3, 4.0}, delta, {false, 0.0}).ok());
    CHECK(judge_ray(slabs, Span{2.0 - 1.1e-3, 4.0}, delta, {false, 0.0}).missed);
    CHECK(judge_ray(slabs, Span{3.0, 5.0 + 0.9e-3}, delta, {false, 0.0}).ok());
    CHECK(judge_ray(slabs, Span{3.0, 5.0 + 1.1e-3}, delta, {false, 0.0}).missed);
    // Hits off the ray's span, or no number at all, are unfounded.
    CHECK(judge_ray(slabs, Span{3.0, 4.0}, delta, {true, 5.0}).unfounded);
    CHECK(judge_ray(slabs, Span{1.0, 0.0}, delta, {true, 0.5}).unfounded);
    CHECK(judge_ray(slabs, Span{1.0, 0.0}, delta, {false, 0.0}).ok());
    CHECK(judge_ray(slabs, Span{0.0, 4.0}, delta, {true, NAN}).unfounded);
}

TEST_CASE("two thin slabs with a slit between them that is finer than the walk are not taken for a thick one") {
    std::mt19937_64 random(8);
    const Tolerance delta{1e-3, 0.0};
    for (int trial = 0; trial < 500; ++trial) {
        const double begin = uniform(random, 1.0, 2.0), slit = begin + 0.7e-3;
        const Slabs slit_slabs{{{begin, slit}, {slit + 0.05e-3, slit + 0.8e-3}}, 16.0};
        CHECK(judge_ray(slit_slabs, Span{0.0, 4.0}, delta, {false, 0.0}).ok());
    }
}

TEST_CASE("a tolerance that vanishes at the origin does not stall the walk") {
    const Tolerance delta{0.0, 1e-4};
    const Slabs slabs{{{1e-6, 2e-6}, {3.0, 3.1}}, 8.0};
    const Verdict late = judge_ray(slabs, Span{0.0, 10.0}, delta, {true, 3.0});
    CHECK(late.missed);
    CHECK(late.probes < 1000000);
    CHECK(judge_ray(slabs, Span{0.0, 10.0}, delta, {true, 1e-6}).ok());
}

TEST_CASE("a touching root is never called a violation of either promise") {
    const Tolerance delta{1e-3, 0.0};
    const auto touching = [](double t) { return Probe{(t - 1.0) * (t - 1.0), std::abs(t - 1.0)}; };
    CHECK(judge_ray(touching, Span{0.0, 2.0}, delta, {false, 0.0}).ok());
    CHECK(judge_ray(touching, Span{0.0, 2.0}, delta, {true, 1.0004}).ok());
    CHECK(judge_ray(touching, Span{0.0, 2.0}, delta, {true, 1.002}).unfounded);
}

TEST_CASE("planes and spheres without noise are judged by their known roots") {
    std::mt19937_64 random(2);
    std::normal_distribution<double> normal;
    Shape plane{.kind = Kind::terrain, .octaves = 3, .amplitude = 0.0};
    Shape sphere{.kind = Kind::planet, .octaves = 3, .amplitude = 0.0, .radius = 2.0};
    const FieldOracle plane_field(plane), sphere_field(sphere);
    const Tolerance delta{1e-4, 1e-4};
    int chords = 0, thin_chords = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        Vec direction{normal(random), normal(random), normal(random)};
        const double length = std::hypot(direction[0], direction[1], direction[2]);
        for (double& x : direction) x /= length;

        const Vec above{normal(random), uniform(random, 0.1, 3.0), normal(random)};
        const double root = -above[1] / direction[1];
        if (root > 0.0 && root < 90.0) {
            CHECK(judge_ray(plane_field, above, direction, 100.0, delta, {true, root}).ok());
            CHECK(judge_ray(plane_field, above, direction, 100.0, delta, {false, 0.0}).missed);
            CHECK(judge_ray(plane_field, above, direction, 100.0, delta, {true, root + 1.1 * delta(root)}).missed);
            CHECK(judge_ray(plane_field, above, direction, 100.0, delta, {true, root - 1.1 * delta(root)}).unfounded);
        } else if (root < 0.0) {
            CHECK(judge_ray(plane_field, above, direction, 100.0, delta, {false, 0.0}).ok());
        }

        // A chord of chosen half length: the ray's middle at distance sqrt(R^2 - half^2) from the centre.
        const double half = std::exp(uniform(random, std::log(1e-4), std::log(1.9)));
        Vec side{direction[1], -direction[0], 0.0};
        const double norm = std::hypot(side[0], side[1]);
        Vec origin;
        for (std::size_t a = 0; a < 3; ++a)
            origin[a] = side[a] / norm * std::sqrt(4.0 - half * half) - 5.0 * direction[a];
        const double enter = 5.0 - half;
        CHECK(judge_ray(sphere_field, origin, direction, 100.0, delta, {true, enter + 0.5 * delta(enter)}).ok());
        const bool thin = 2.0 * half < delta(5.0 + half);
        if (std::abs(2.0 * half / delta(5.0 + half) - 1.0) < 1e-6) continue;
        CHECK(judge_ray(sphere_field, origin, direction, 100.0, delta, {false, 0.0}).missed == !thin);
        ++(thin ? thin_chords : chords);
    }
    MESSAGE(chords << " chords longer than the tolerance, " << thin_chords << " shorter");
    CHECK(thin_chords > 50);
    CHECK(chords > 500);
}
