// Values, gradients and Hessians of gradient noise from the oracle's formulas, in long double, by automatic
// differentiation; and the SIMD targets to compare them on. Shares no code with the noise library.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "noise/simd_target.h"
#include "tests/oracles/noise_oracle.h"

namespace strata::noise::test {

// A number with its first and second partial derivatives by D variables.
template <std::size_t D>
struct Dual2 {
    long double value = 0;
    std::array<long double, D> gradient{};
    std::array<std::array<long double, D>, D> hessian{};

    Dual2() = default;
    Dual2(long double constant) : value(constant) {}  // implicit: constants mix with variables in formulas

    static Dual2 variable(long double value, std::size_t axis) {
        Dual2 x(value);
        x.gradient[axis] = 1;
        return x;
    }

    friend Dual2 operator+(Dual2 a, const Dual2& b) {
        a.value += b.value;
        for (std::size_t i = 0; i < D; ++i) {
            a.gradient[i] += b.gradient[i];
            for (std::size_t j = 0; j < D; ++j) a.hessian[i][j] += b.hessian[i][j];
        }
        return a;
    }

    friend Dual2 operator*(const Dual2& a, const Dual2& b) {
        Dual2 product(a.value * b.value);
        for (std::size_t i = 0; i < D; ++i) {
            product.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
            for (std::size_t j = 0; j < D; ++j) {
                product.hessian[i][j] = a.hessian[i][j] * b.value + a.gradient[i] * b.gradient[j] +
                                        a.gradient[j] * b.gradient[i] + a.value * b.hessian[i][j];
            }
        }
        return product;
    }

    friend Dual2 operator-(const Dual2& a, const Dual2& b) { return a + Dual2(-1) * b; }
};

template <std::size_t D>
Dual2<D> oracle_jet(const std::array<std::uint32_t, 3>& key, const std::array<std::int64_t, D>& cell,
                    const std::array<long double, D>& fraction) {
    namespace oracle = strata::oracle::detail;
    using Real = Dual2<D>;
    std::array<Real, D> x;
    for (std::size_t a = 0; a < D; ++a) x[a] = Real::variable(fraction[a], a);
    const auto corner = [&](int i, int j, int k) {
        std::uint32_t word = oracle::plane_hash(cell[0] + i, key[0]) ^ oracle::plane_hash(cell[1] + j, key[1]);
        if constexpr (D == 2) {
            return oracle::gradient_dot<Real>(word * 2246822519u, x[0] - i, x[1] - j);
        } else {
            word ^= oracle::plane_hash(cell[2] + k, key[2]);
            return oracle::gradient_dot<Real>(word * 2246822519u, x[0] - i, x[1] - j, x[2] - k);
        }
    };
    const auto face = [&](int k) {
        const Real u = oracle::smooth<Real>(x[0]), v = oracle::smooth<Real>(x[1]);
        return oracle::mix<Real>(oracle::mix<Real>(corner(0, 0, k), corner(1, 0, k), u),
                                 oracle::mix<Real>(corner(0, 1, k), corner(1, 1, k), u), v);
    };
    if constexpr (D == 2) return face(0);
    return oracle::mix<Real>(face(0), face(1), oracle::smooth<Real>(x[D - 1]));
}

// A position as whole cells from a base cell plus an offset that need not lie in [0,1).
template <std::size_t D>
Dual2<D> oracle_jet_at(const std::array<std::uint32_t, 3>& key, std::array<std::int64_t, D> cell,
                       std::array<long double, D> offset) {
    for (std::size_t a = 0; a < D; ++a) {
        const long double whole = std::floor(offset[a]);
        cell[a] += static_cast<std::int64_t>(whole);
        offset[a] -= whole;
    }
    return oracle_jet<D>(key, cell, offset);
}

// All targets, before any is pinned: a pin hides the others.
inline const std::vector<std::string>& all_targets() {
    static const std::vector<std::string> targets = simd_targets();
    return targets;
}

// Runs body(target's name) with each SIMD target that this machine has, and leaves the best one in use.
template <class Body>
void for_each_target(const Body& body) {
    const std::vector<std::string>& targets = all_targets();
    REQUIRE_FALSE(targets.empty());
    for (const std::string& target : targets) {
        REQUIRE(pin_simd_target(target));
        CAPTURE(target);
        body(target);
    }
    REQUIRE(pin_simd_target(targets.front()));
}

}  // namespace strata::noise::test
