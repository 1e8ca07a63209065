#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "noise/noise.h"
#include "noise/reference.h"
#include "tests/noise/batch_case.h"
#include "tests/noise/float_difference.h"
#include "tests/noise/oracle_jet.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

template <std::size_t D>
void check_against_oracle() {
    constexpr std::size_t kCases = 600, kCount = 37;
    std::mt19937_64 random(D);
    std::vector<Case<D>> cases;
    std::vector<std::vector<Dual2<D>>> expected(kCases);
    for (std::vector<Dual2<D>>& jets : expected) {
        const Case<D> c = cases.emplace_back(random_case<D>(kCount, random));
        for (std::size_t i = 0; i < kCount; ++i) {
            jets.push_back(oracle_jet_at<D>(c.key.axis, c.base, position<D>(c.offsets, i)));
        }
    }
    for_each_target([&](const std::string& target) {
        Errors worst;
        for (std::size_t k = 0; k < kCases; ++k) {
            const Output<D> found = evaluate<D>(cases[k].key, cases[k].base, cases[k].offsets);
            for (std::size_t i = 0; i < kCount; ++i)
                worst = larger(worst, difference<D>(expected[k][i], point_of<D>(found, i)));
        }
        check_within<D>(worst, std::to_string(D) + "-D " + target);
    });
}

template <std::size_t D>
void check_reference() {
    std::mt19937_64 random(50 + D);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Errors worst;
    for (int trial = 0; trial < 20000; ++trial) {
        const LatticeKey key = lattice_key(random(), 0);
        LatticePoint<D> at;
        std::array<long double, D> x;
        for (std::size_t a = 0; a < D; ++a) {
            at.cell[a] = random_base(random);
            at.fraction[a] = random() % 4 ? unit(random) : static_cast<double>(random() % 3) / 2.0;
            x[a] = static_cast<long double>(at.fraction[a]);
        }
        const Dual2<D> expected = oracle_jet<D>(key.axis, at.cell, x);
        worst = larger(worst, difference<D>(expected, reference_jet<D>(key, at)));
        const auto value_error = std::abs(static_cast<double>(reference_value<D>(key, at) - expected.value));
        worst.value = std::max(worst.value, value_error);
    }
    MESSAGE(D << "-D largest errors: value " << worst.value << ", slope " << worst.slope << ", second " << worst.entry);
    // A few ulp of the sum of the corners' gradients, 11.3, times 1, 1.875 and 5.78, the fade's derivatives.
    CHECK(worst.value < 1e-14);
    CHECK(worst.slope < 2e-14);
    CHECK(worst.entry < 6e-14);
}

// A plane from its two sides: cell -1 at a fraction that rounds to 1, and cell 0 at fraction 0.
template <std::size_t D>
void check_continuity() {
    for_each_target([&](const std::string& target) {
        std::mt19937_64 random(60 + D);
        Errors worst;
        for (int trial = 0; trial < 300; ++trial) {
            Case<D> before = random_case<D>(19, random);
            Case<D> after = before;
            const std::size_t axis = random() % D;
            for (std::size_t i = 0; i < 19; ++i) {
                before.offsets[axis][i] = -1e-30f;
                after.offsets[axis][i] = 0.0f;
            }
            const Output<D> low = evaluate<D>(before.key, before.base, before.offsets);
            const Output<D> high = evaluate<D>(after.key, after.base, after.offsets);
            for (std::size_t i = 0; i < 19; ++i)
                worst = larger(worst, difference<D>(point_of<D>(low, i), point_of<D>(high, i)));
        }
        CHECK(worst.value <= 2 * kFloatErrors<D>.value);
        CHECK(worst.slope <= 2 * kFloatErrors<D>.slope);
        CHECK(worst.entry <= 2 * kFloatErrors<D>.hessian_entry);
        MESSAGE(D << "-D " << target << ": largest jumps " << worst.value << ", " << worst.slope << ", "
                  << worst.entry);
    });
}

// Counts around multiples of 1, 4, 8 and 16 lanes, each point compared with itself alone.
template <std::size_t D>
void check_counts_and_positions() {
    for_each_target([&](const std::string&) {
        std::mt19937_64 random(70 + D);
        for (const std::size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 14, 15, 16, 17, 26, 31, 33, 50, 65}) {
            const Case<D> c = random_case<D>(count, random);
            const Output<D> together = evaluate<D>(c.key, c.base, c.offsets);
            Offsets<D> reversed = c.offsets;
            for (auto& axis : reversed) {
                std::reverse(axis.begin(), axis.end());
                axis.insert(axis.begin(), 0.25f);
            }
            const Output<D> backwards = evaluate<D>(c.key, c.base, reversed);
            for (std::size_t i = 0; i < count; ++i) {
                Offsets<D> alone;
                for (std::size_t a = 0; a < D; ++a) alone[a] = {c.offsets[a][i]};
                CHECK(together.same_point(i, evaluate<D>(c.key, c.base, alone), 0));
                CHECK(together.same_point(i, backwards, count - i));
            }
        }
    });
}

template <std::size_t D>
void check_bounds() {
    constexpr std::size_t kCount = 200000;
    for_each_target([&](const std::string& target) {
        std::mt19937_64 random(80 + D);
        const Case<D> c = random_case<D>(kCount, random);
        const Output<D> found = evaluate<D>(c.key, c.base, c.offsets);
        double value = 0.0, slope = 0.0;
        for (std::size_t i = 0; i < kCount; ++i) {
            double squared = 0.0;
            for (std::size_t a = 0; a < D; ++a) squared += std::pow(static_cast<double>(found.gradient[a][i]), 2);
            slope = std::max(slope, std::sqrt(squared));
            value = std::max(value, std::abs(static_cast<double>(found.value[i])));
        }
        CHECK(value <= kNoiseBounds<D>.value);
        CHECK(slope <= kNoiseBounds<D>.gradient);
        MESSAGE(D << "-D " << target << ", of the bounds: value " << value / kNoiseBounds<D>.value << ", gradient "
                  << slope / kNoiseBounds<D>.gradient);
    });
}

}  // namespace

TEST_CASE("the reference path's value, gradient and Hessian are the oracle's") {
    check_reference<2>();
    check_reference<3>();
}

TEST_CASE("batches are within the stated float errors of the oracle on every SIMD target") {
    check_against_oracle<2>();
    check_against_oracle<3>();
}

TEST_CASE("value, gradient and Hessian agree on both sides of a lattice plane") {
    check_continuity<2>();
    check_continuity<3>();
}

TEST_CASE("a point's bits depend on neither its neighbours nor its place, and nothing is written past the end") {
    check_counts_and_positions<2>();
    check_counts_and_positions<3>();
}

TEST_CASE("no evaluation exceeds the bounds of value and gradient") {
    check_bounds<2>();
    check_bounds<3>();
}
