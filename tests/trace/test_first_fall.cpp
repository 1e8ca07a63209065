// The first fall of a parabola through zero: what float makes of it is the root of a parabola hardly another one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "noise/simd_target.h"
#include "tests/support/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/trace/test_first_fall.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/first_fall-inl.h"

#ifndef STRATA_TEST_FIRST_FALL_CASE
#define STRATA_TEST_FIRST_FALL_CASE
namespace strata::trace {

struct Parabola {
    float c0 = 0.0f, c1 = 0.0f, c2 = 0.0f;
};

struct Fall {
    float no_later = 0.0f, no_sooner = 0.0f;
    float pad = 0.0f;
};

}  // namespace strata::trace
#endif

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

Fall FindFall(const Parabola& p) {
    const FloatTag d;
    const FloatVec c0 = hn::Set(d, p.c0), c1 = hn::Set(d, p.c1), c2 = hn::Set(d, p.c2);
    return {hn::GetLane(fall_no_later(c0, c1, c2)), hn::GetLane(fall_no_sooner(c0, c1, c2)),
            kFallPad * hn::GetLane(fall_size(c0, c1, c2))};
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(FindFall);

namespace {

using support::log_uniform;
using support::Random;
using support::uniform;

double some(Random& random) { return (random() % 2 == 0 ? 1.0 : -1.0) * log_uniform(random, 1e-9, 1e3); }

// Any; such as touch zero, where the discriminant all but vanishes; and such as fall at the very end of [0, 1].
Parabola random_parabola(Random& random) {
    const double c0 = log_uniform(random, 1e-9, 1e3);
    switch (random() % 3) {
        case 0:
            return {static_cast<float>(c0), static_cast<float>(some(random)), static_cast<float>(some(random))};
        case 1: {
            const double at = log_uniform(random, 1e-3, 1.2), off = 1.0 + some(random) * 1e-9;
            return {static_cast<float>(c0), static_cast<float>(-2.0 * c0 / at * off), static_cast<float>(c0 / at / at)};
        }
        default: {
            const double c2 = some(random);
            return {static_cast<float>(c0), static_cast<float>(-(c0 + c2)), static_cast<float>(c2)};
        }
    }
}

long double value(const Parabola& p, long double x) {
    return static_cast<long double>(p.c0) + x * (static_cast<long double>(p.c1) + x * static_cast<long double>(p.c2));
}

// On [from, to].
long double least(const Parabola& p, long double from, long double to) {
    long double result = std::min(value(p, from), value(p, to));
    if (p.c2 > 0.0f) {
        const long double vertex = -static_cast<long double>(p.c1) / (2.0L * static_cast<long double>(p.c2));
        if (vertex > from && vertex < to) result = std::min(result, value(p, vertex));
    }
    return result;
}

}  // namespace

TEST_CASE("before its first fall a parabola is above 0, and about there it is not, but for the pad") {
    const std::vector<std::string> targets = noise::simd_targets();
    for (const std::string& target : targets) {
        REQUIRE(noise::pin_simd_target(target));
        Random random(3);
        long double above = 0.0L, below = 0.0L;  // greatest parts of the pad that were needed
        int falls = 0, touches = 0;
        for (int trial = 0; trial < 200000; ++trial) {
            const Parabola p = random_parabola(random);
            const Fall fall = HWY_DYNAMIC_DISPATCH(FindFall)(p);
            const long double pad = fall.pad;
            REQUIRE(fall.no_later <= fall.no_sooner);
            const long double before = least(p, 0.0L, std::min(1.0L, static_cast<long double>(fall.no_later)));
            below = std::max(below, -before / pad);
            touches += before < 0.0L;
            if (fall.no_sooner > 1.0f) continue;
            ++falls;
            above = std::max(above, least(p, fall.no_later, fall.no_sooner) / pad);
        }
        MESSAGE(target << ": " << falls << " falls; f below 0 before " << touches << " of them, by "
                       << static_cast<double>(below) << " of the pad; above it there by "
                       << static_cast<double>(above));
        CHECK(below < 1.0L);
        CHECK(above < 1.0L);
        CHECK(falls > 50000);
        CHECK(HWY_DYNAMIC_DISPATCH(FindFall)({0.0f, 1.0f, 1.0f}).no_sooner == 0.0f);
        CHECK(HWY_DYNAMIC_DISPATCH(FindFall)({-1.0f, 5.0f, 0.0f}).no_sooner == 0.0f);
        CHECK(HWY_DYNAMIC_DISPATCH(FindFall)({1.0f, 0.0f, 0.0f}).no_later > 1e29f);
        CHECK(HWY_DYNAMIC_DISPATCH(FindFall)({1.0f, 1.0f, 1.0f}).no_later > 1e29f);
        CHECK(HWY_DYNAMIC_DISPATCH(FindFall)({1.0f, -1.0f, 1.0f}).no_later > 1e29f);
    }
    noise::pin_simd_target(targets.front());
}

}  // namespace strata::trace
#endif  // HWY_ONCE
