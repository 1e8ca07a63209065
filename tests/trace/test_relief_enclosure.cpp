// What the tracers' vectors of floats claim of a relief in a ball, against the reference path in double and the oracle.
#include <doctest/doctest.h>

#include <algorithm>

#include <hwy/highway.h>

#define STRATA_RELIEF_FORMULAS
#include "src/trace/relief_lanes-inl.h"
#include "tests/trace/relief_families.h"

namespace {

using namespace strata;
using namespace strata::trace_test;
namespace simd = strata::trace::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

// One lane of an enclosure.
struct Claim {
    double value;
    glm::dvec3 gradient;
    double up[3], down[3];
};

Claim lane0(const simd::Enclosure& e) {
    const auto first = [](simd::FloatVec v) { return static_cast<double>(hn::GetLane(v)); };
    return {first(e.value),
            {first(e.gradient.x), first(e.gradient.y), first(e.gradient.z)},
            {first(e.up.e0), first(e.up.e1), first(e.up.e2)},
            {first(e.down.e0), first(e.down.e1), first(e.down.e2)}};
}

Claim claim_at(const trace::ReliefPlan& plan, const glm::dvec3& x, double radius, bool whole, bool planar) {
    const simd::FloatTag d;
    const auto wide = [](double v) {
        return simd::each_part([&](auto) { return hn::Set(simd::DoubleTag(), v); }, simd::Wide{});
    };
    simd::FloatVec evaluations = hn::Zero(d);
    auto broken = hn::Lt(evaluations, evaluations);
    trace::TraceCounters counters;
    const auto all = hn::Eq(evaluations, evaluations), none = hn::Lt(evaluations, evaluations);
    const simd::ReliefPoints points{
        hn::Set(d, static_cast<float>(radius)), all, whole ? all : none, &counters, &evaluations, &broken};
    const simd::WidePoint at{wide(x.x), wide(x.y), wide(x.z)};
    const double reach = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) + radius;
    return lane0(planar ? simd::enclose<true>(plan, at, reach, points) : simd::enclose<false>(plan, at, reach, points));
}

double slack(const double (&e)[3], double distance) { return e[0] + e[1] * distance + e[2] * distance * distance; }

}  // namespace

TEST_CASE("a landform of any terms has the values that the oracle reads") {
    Random random(21);
    for (int i = 0; i < 60; ++i) {
        const auto terms = random_landform(random);
        const noise::Relief relief(terms, 2);
        const oracle::ReliefOracle judge(terms, true);
        for (int j = 0; j < 50; ++j) {
            const glm::dvec3 x = uniform(random, 0.0, 30.0) * unit_vector(random);
            const double value = relief.jet(x).value;
            REQUIRE(value == doctest::Approx(judge.value({x.x, x.y, x.z})).epsilon(1e-9));
            const oracle::ReliefOracle::Rough rough = judge.rough({x.x, x.y, x.z});
            REQUIRE(value <= rough.high + 1e-9);
            REQUIRE(value >= rough.low - 1e-9);
        }
    }
}

TEST_CASE("in the ball around any point a relief stays between the enclosure's bounds") {
    Random random(22);
    std::size_t checked = 0;
    double tightest = 0.0;
    for (int i = 0; i < 160; ++i) {
        const bool planar = i % 2 == 0;
        const auto terms = planar ? random_landform(random) : random_relief(random);
        const noise::Relief relief(terms, planar ? 2 : 3);
        const trace::ReliefPlan plan(relief);
        for (int j = 0; j < 40; ++j) {
            const glm::dvec3 x = uniform(random, 0.0, 30.0) * unit_vector(random);
            const double radius = log_uniform(random, 1e-5, 3.0);
            const bool whole = random() % 4 == 0;
            const Claim claim = claim_at(plan, x, radius, whole, planar);
            for (int k = 0; k < 30; ++k) {
                glm::dvec3 step = unit_vector(random);
                if (planar) step = glm::normalize(glm::dvec3(step.x, 0.0, step.z));
                const double distance = radius * (k == 0 ? 0.0 : std::sqrt(uniform(random, 0.0, 1.0)));
                const double line = claim.value + distance * glm::dot(claim.gradient, step);
                const double off = relief.jet(x + distance * step).value - line;
                INFO("terms " << terms.size() << " last " << terms.back().name << " radius " << radius << " whole "
                              << whole << " distance " << distance << " off " << off << " up "
                              << slack(claim.up, distance) << " down " << slack(claim.down, distance));
                REQUIRE(off <= slack(claim.up, distance));
                REQUIRE(-off <= slack(claim.down, distance));
                tightest = std::max({tightest, off / slack(claim.up, distance), -off / slack(claim.down, distance)});
                ++checked;
            }
        }
    }
    MESSAGE(checked << " points, bounds attained to " << tightest);
    CHECK(tightest > 0.3);
}

TEST_CASE("at a point alone the gradient is the reference path's, also behind a curve through heights of kilometres") {
    Random random(23);
    double worst = 0.0;
    const auto check = [&](const std::vector<noise::ReliefTerm>& terms, bool planar, double size) {
        const noise::Relief relief(terms, planar ? 2 : 3);
        const trace::ReliefPlan plan(relief);
        for (int j = 0; j < 40; ++j) {
            const glm::dvec3 x = size * uniform(random, 0.0, 1.0) * unit_vector(random);
            const glm::dvec3 expected = relief.jet(x).gradient;
            const glm::dvec3 gradient = claim_at(plan, x, 0.0, true, planar).gradient;
            const double off = glm::length(gradient - expected) / (1.0 + glm::length(expected));
            INFO("terms " << terms.size() << " last " << terms.back().name);
            REQUIRE(off < 2e-3);
            worst = std::max(worst, off);
        }
    };
    for (int i = 0; i < 100; ++i) check(random_landform(random), true, 30.0);
    for (int i = 0; i < 100; ++i) check(random_relief(random), false, 30.0);
    noise::Envelope mound;
    mound.x_size = mound.z_size = 8000.0;
    mound.least = 0.0;
    mound.lift = 1.0;
    noise::Curve crater;
    crater.from = {0.02, 0.25, 0.7};
    crater.to = {0.0, 520.0, -2200.0};
    check({{"mound", {}, mound}, {"crater", {"mound"}, crater}}, true, 12000.0);
    MESSAGE("gradients are off by " << worst << " of 1 + their length at most");
}
