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
#include "noise/noise.h"
#include "noise/reference.h"
#include "tests/noise/batch_case.h"
#include "tests/noise/oracle_jet.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

// The bounds of src/trace/trace_plan.h, which derives them and whose floor is above this one.
constexpr double kValueError = 0x1p-15;
constexpr double kSlopeError = 0x1p-13;

// One entry of the Hessian, in units of 2^-24, after the same derivation. Diagonal: |fade''| <= 5.78 times the error
// 472 of a face difference, an error of 60 of fade'' times the difference 3, 2 * 1.875 times the error 308 of a
// gradient component's difference, the error 12 of fade' times 2 * 2: 4113. Off the diagonal: 1.875^2 times the error
// 492 of the mixed difference, 2 * 12 * 1.875 * 6, 2 * 1.875 * 308, 2 * 12 * 2: 3203. The fraction's error through the
// third derivative: 151. In all below 2^-11.
constexpr double kHessianError = 0x1p-11;

template <std::size_t D>
std::array<long double, D> position(const Offsets<D>& offsets, std::size_t i) {
    std::array<long double, D> x;
    for (std::size_t a = 0; a < D; ++a) x[a] = static_cast<long double>(offsets[a][i]);
    return x;
}

struct Errors {
    double value = 0.0, slope = 0.0, hessian = 0.0;
};

// The slope's error is the largest over unit directions: the length of the gradient's error.
template <std::size_t D, class Found>
void compare(const Dual2<D>& expected, const Found& found, Errors& worst) {
    long double slope = 0;
    worst.value = std::max(worst.value, static_cast<double>(std::abs(found.value - expected.value)));
    for (std::size_t a = 0; a < D; ++a) {
        slope += std::pow(found.gradient[a] - expected.gradient[a], 2);
        for (std::size_t b = 0; b < D; ++b) {
            const long double error = std::abs(found.hessian[a][b] - expected.hessian[a][b]);
            worst.hessian = std::max(worst.hessian, static_cast<double>(error));
        }
    }
    worst.slope = std::max(worst.slope, static_cast<double>(std::sqrt(slope)));
}

template <std::size_t D>
Dual2<D> point_of(const Output<D>& output, std::size_t i) {
    Dual2<D> jet(static_cast<long double>(output.value[i]));
    for (std::size_t a = 0; a < D; ++a) {
        jet.gradient[a] = static_cast<long double>(output.gradient[a][i]);
        for (std::size_t b = 0; b < D; ++b)
            jet.hessian[a][b] = static_cast<long double>(output.hessian[entry<D>(a, b)][i]);
    }
    return jet;
}

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
            for (std::size_t i = 0; i < kCount; ++i) compare<D>(expected[k][i], point_of<D>(found, i), worst);
        }
        CHECK(worst.value <= kValueError);
        CHECK(worst.slope <= kSlopeError);
        CHECK(worst.hessian <= kHessianError);
        MESSAGE(D << "-D " << target << ", of the bounds: value " << worst.value / kValueError << ", slope "
                  << worst.slope / kSlopeError << ", Hessian " << worst.hessian / kHessianError);
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
        compare<D>(expected, reference_jet<D>(key, at), worst);
        const auto value_error = std::abs(static_cast<double>(reference_value<D>(key, at) - expected.value));
        worst.value = std::max(worst.value, value_error);
    }
    MESSAGE(D << "-D largest errors: value " << worst.value << ", slope " << worst.slope << ", second "
              << worst.hessian);
    // A few ulp of the sum of the corners' gradients, 11.3, times 1, 1.875 and 5.78, the fade's derivatives.
    CHECK(worst.value < 1e-14);
    CHECK(worst.slope < 2e-14);
    CHECK(worst.hessian < 6e-14);
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
            for (std::size_t i = 0; i < 19; ++i) compare<D>(point_of<D>(low, i), point_of<D>(high, i), worst);
        }
        CHECK(worst.value <= 2 * kValueError);
        CHECK(worst.slope <= 2 * kSlopeError);
        CHECK(worst.hessian <= 2 * kHessianError);
        MESSAGE(D << "-D " << target << ": largest jumps " << worst.value << ", " << worst.slope << ", "
                  << worst.hessian);
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
