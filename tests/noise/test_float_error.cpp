// How large the errors that noise/float_error.h bounds get: fractions where roundings are worst, then a climb from the
// worst found. Positions are float offsets, taken exactly, so that the fraction's rounding counts.
#include "noise/float_error.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/noise/batch_case.h"
#include "tests/noise/float_difference.h"
#include "tests/noise/oracle_jet.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

using Random = std::mt19937_64;

// An offset in (-1, 1), below 0 of a fraction that is rounded: anywhere; a few floats beside multiples of 1/8, where
// the fade's roundings change size; close to a plane; not normal.
float adversarial_offset(Random& random) {
    std::uniform_real_distribution<float> anywhere(-1.0f, 1.0f);
    const float sign = random() % 2 ? 1.0f : -1.0f;
    switch (random() % 8) {
        case 0: {
            float x = static_cast<float>(static_cast<int>(random() % 15) - 7) / 8.0f;
            for (std::size_t steps = random() % 4; steps > 0; --steps) x = std::nextafter(x, sign);
            return x;
        }
        case 1:
            return sign * std::ldexp(1.0f, -static_cast<int>(random() % 30)) * std::abs(anywhere(random));
        case 2:
            return sign * (1.0f - std::ldexp(std::abs(anywhere(random)), -static_cast<int>(random() % 24)));
        case 3:
            return sign * static_cast<float>(random() % 3) * std::numeric_limits<float>::denorm_min();
        default:
            return anywhere(random);
    }
}

template <std::size_t D>
struct Place {
    LatticeKey key;
    std::array<std::int64_t, D> cell{};
    std::array<float, D> offset{};
};

template <std::size_t D>
Errors errors_at(const Place<D>& place) {
    Offsets<D> offsets;
    for (std::size_t a = 0; a < D; ++a) offsets[a] = {place.offset[a]};
    const Output<D> found = evaluate<D>(place.key, place.cell, offsets);
    return difference<D>(oracle_jet_at<D>(place.key.axis, place.cell, position<D>(offsets, 0)), point_of<D>(found, 0));
}

template <std::size_t D>
Place<D> random_place(Random& random) {
    Place<D> place{lattice_key(random(), 0), {}, {}};
    for (std::size_t a = 0; a < D; ++a) {
        place.cell[a] = static_cast<std::int64_t>(random() % 64) - 32;
        place.offset[a] = adversarial_offset(random);
    }
    return place;
}

// Moves each axis by anything from an ulp to a quarter.
template <std::size_t D>
Place<D> nearby(Place<D> place, Random& random) {
    std::uniform_real_distribution<float> step(-0.5f, 0.5f);
    for (float& x : place.offset) {
        if (random() % 3) x = std::clamp(x + std::ldexp(step(random), -static_cast<int>(random() % 26)), -1.0f, 1.0f);
    }
    return place;
}

// Climbs what `of` takes from the errors, from the worst of many places; returns the errors met.
template <std::size_t D>
Errors climb(double Errors::*of, Random& random) {
    constexpr int kStarts = 3000, kSteps = 1500;
    Errors met, best;
    Place<D> at;
    const auto visit = [&](const Place<D>& place) {
        const Errors e = errors_at<D>(place);
        met = larger(met, e);
        if (e.*of >= best.*of) best = e, at = place;
    };
    for (int i = 0; i < kStarts; ++i) visit(random_place<D>(random));
    for (int i = 0; i < kSteps; ++i) visit(nearby<D>(at, random));
    return met;
}

template <std::size_t D>
void check_adversaries() {
    for_each_target([](const std::string& target) {
        Random random(90 + D);
        Errors worst;
        for (double Errors::*of : {&Errors::value, &Errors::axis, &Errors::slope, &Errors::entry}) {
            worst = larger(worst, climb<D>(of, random));
        }
        check_within<D>(worst, std::to_string(D) + "-D " + target);
        CHECK(worst.value > 0.1 * kFloatErrors<D>.value);  // or the bound, or the search, is useless
    });
}

}  // namespace

TEST_CASE("2-D noise errs by less than stated where roundings are worst, on every SIMD target") {
    check_adversaries<2>();
}

TEST_CASE("3-D noise errs by less than stated where roundings are worst, on every SIMD target") {
    check_adversaries<3>();
}
