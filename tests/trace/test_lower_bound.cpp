// The quadratic lower bound of f along a ray as a theorem: wherever octaves can go from what is known of them here, f
// stays positive up to the root.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "noise/bounds.h"
#include "noise/simd_target.h"
#include "src/trace/trace_plan.h"
#include "tests/support/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/trace/test_lower_bound.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/lower_bound-inl.h"

#ifndef STRATA_TEST_LOWER_BOUND_CASE
#define STRATA_TEST_LOWER_BOUND_CASE
namespace strata::trace {

// What one ray knows at a point: base and its slope, each octave's value and slope, a hinted step.
struct BoundCase {
    float f = 0.0f;  // base minus all octaves
    float base_slope = 0.0f;
    float hint = 0.0f;
    std::vector<float> value, slope;
};

struct Quadratic {
    float c0 = 0.0f, c1 = 0.0f, c2 = 0.0f;
};

}  // namespace strata::trace
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// As the tracer solves it, one case in every lane.
float Step(const TracePlan& plan, const BoundCase& at) {
    const FloatTag d;
    const FloatVec hint = hn::Set(d, at.hint);
    OctaveBounds bounds = no_bounds();
    for (std::size_t k = 0; k < plan.octaves.size(); ++k) {
        const FloatVec wh = hn::Mul(hn::Set(d, plan.octaves[k].wave), hint);
        bounds = add_octave(bounds, plan, plan.octaves[k], hn::Set(d, at.value[k]), hn::Set(d, at.slope[k]), wh, wh,
                            hn::MaskFromVec(hn::BitCast(d, hn::Set(WordTag(), ~0u))));
    }
    const float error = std::abs(at.f) * plan.error_relative + plan.error_absolute;
    const FloatVec certain = hn::Set(d, at.f - error);
    const FloatVec slope = hn::Set(d, at.base_slope - plan.slope_error);
    const FloatVec root = first_root(hn::Sub(certain, bounds.drop), hn::MulAdd(slope, hint, bounds.slope), bounds.bend);
    return hn::GetLane(hn::Mul(root, hint));
}

float Root(const Quadratic& q) {
    const FloatTag d;
    return hn::GetLane(first_root(hn::Set(d, q.c0), hn::Set(d, q.c1), hn::Set(d, q.c2)));
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(Step);
HWY_EXPORT(Root);

namespace {

using support::log_uniform;
using support::uniform;

// The least that f can be after a step s: every octave at the least of its three bounds.
long double worst_f(const Field& field, const BoundCase& at, long double s) {
    const noise::NoiseBounds& b = noise::kBounds3;
    long double f = at.f + static_cast<long double>(at.base_slope) * s;
    for (std::size_t k = 0; k < field.octaves().size(); ++k) {
        const noise::Octave& octave = field.octaves()[k];
        const long double ws = octave.frequency * s, v = at.value[k];
        const long double lipschitz = b.gradient * ws, taylor = at.slope[k] * ws + 0.5L * b.second * ws * ws;
        f -= octave.amplitude * std::min({static_cast<long double>(b.value) - v, lipschitz, taylor});
    }
    return f;
}

BoundCase random_case(std::mt19937_64& random, const Field& field) {
    BoundCase at;
    at.f = static_cast<float>(field.amplitude() * log_uniform(random, 1e-4, 10.0));
    at.base_slope = static_cast<float>(uniform(random, -1.0, 1.0));
    at.hint = static_cast<float>(log_uniform(random, 1e-6, 1e6) / field.octaves().front().frequency);
    const double typical = uniform(random, 0.05, 1.0);  // most places are far from the extremes
    for (std::size_t k = 0; k < field.octaves().size(); ++k) {
        at.value.push_back(static_cast<float>(typical * uniform(random, -1.0363, 1.0363)));
        at.slope.push_back(static_cast<float>(typical * uniform(random, -3.75, 3.75)));
    }
    return at;
}

}  // namespace

TEST_CASE("no octave can bring f to zero before the certified step, whatever the hint, on every SIMD target") {
    const std::vector<std::string> targets = noise::simd_targets();
    for (const std::string& target : targets) {
        REQUIRE(noise::pin_simd_target(target));
        std::mt19937_64 random(7);
        int longest = 0;
        int positive = 0;
        for (int trial = 0; trial < 4000; ++trial) {
            scene::Surface surface;
            surface.kind = solid::kKind<solid::DisplacedPlane>;
            surface.octaves = 1 + static_cast<int>(random() % 16);
            surface.gain = uniform(random, 0.3, 0.7);
            surface.lacunarity = uniform(random, 1.7, 3.0);
            surface.amplitude = log_uniform(random, 1e-3, 1e3);
            surface.frequency = log_uniform(random, 1e-3, 1e3);
            const Field field(surface);
            const TracePlan plan(field);
            const BoundCase at = random_case(random, field);
            const float step = HWY_DYNAMIC_DISPATCH(Step)(plan, at);
            REQUIRE(step >= 0.0f);
            positive += step > 0.0f;
            if (step >= 1e15f) continue;  // a rising base: no root at all
            for (int i = 0; i <= 32; ++i) {
                const long double s = static_cast<long double>(step) * i / 32;
                CAPTURE(target);
                CAPTURE(trial);
                CHECK(worst_f(field, at, s) > 0.0L);
            }
            if (step > 0.0f && worst_f(field, at, 1.02L * static_cast<long double>(step)) < 0.0L) ++longest;
        }
        MESSAGE(target << ": " << positive << " of 4000 hints gave a step, " << longest
                       << " of them within 2 % of the farthest that is safe");
        CHECK(positive > 1000);
        CHECK(longest > 20);
    }
    noise::pin_simd_target(targets.front());
}

TEST_CASE("the first root is rounded down by less than a part in 2^17, over all magnitudes") {
    const std::vector<std::string> targets = noise::simd_targets();
    for (const std::string& target : targets) {
        REQUIRE(noise::pin_simd_target(target));
        std::mt19937_64 random(8);
        long double worst = 0.0L;
        for (int trial = 0; trial < 20000; ++trial) {
            const Quadratic q{static_cast<float>(log_uniform(random, 1e-15, 1e10)),
                              static_cast<float>((trial % 2 ? 1.0 : -1.0) * log_uniform(random, 1e-15, 1e10)),
                              static_cast<float>(log_uniform(random, 1e-15, 1e10))};
            const long double c0 = q.c0, c1 = q.c1, c2 = q.c2;
            const long double root = 2.0L * c0 / (std::sqrt(c1 * c1 + 4.0L * c2 * c0) - c1);
            const long double other = (c1 + std::sqrt(c1 * c1 + 4.0L * c2 * c0)) / (2.0L * c2);
            const long double exact = c1 < 0.0L ? root : other;
            const auto found = static_cast<long double>(HWY_DYNAMIC_DISPATCH(Root)(q));
            CHECK(found <= exact);
            if (exact < 1e30L) worst = std::max(worst, (exact - found) / exact);
        }
        MESSAGE(target << ": at most " << static_cast<double>(worst) << " too short (bound " << 0x1p-17 << ')');
        CHECK(worst < 0x1p-17L);
        CHECK(HWY_DYNAMIC_DISPATCH(Root)({1.0f, 0.0f, 0.0f}) == 1e30f);
        CHECK(HWY_DYNAMIC_DISPATCH(Root)({1.0f, 1.0f, 0.0f}) == 1e30f);
        CHECK(HWY_DYNAMIC_DISPATCH(Root)({0.0f, 1.0f, 1.0f}) == 0.0f);
        CHECK(HWY_DYNAMIC_DISPATCH(Root)({-1.0f, 5.0f, 0.0f}) == 0.0f);
        const float tiny = HWY_DYNAMIC_DISPATCH(Root)({1e-30f, -1e-25f, 0.0f});
        CHECK(tiny <= 1e-5f);
        CHECK(tiny > 0.99e-5f);
    }
    noise::pin_simd_target(targets.front());
}

}  // namespace strata::trace
#endif  // HWY_ONCE
