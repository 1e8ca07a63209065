// Values, gradients and Hessians of gradient noise from the oracle's formulas, in long double, by automatic
// differentiation. Shares no code with the project.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "tools/stability/oracles/noise_oracle.h"

namespace strata::oracle {

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
    using Real = Dual2<D>;
    std::array<Real, D> x;
    for (std::size_t a = 0; a < D; ++a) x[a] = Real::variable(fraction[a], a);
    const auto corner = [&](int i, int j, int k) {
        std::uint32_t word = detail::plane_hash(cell[0] + i, key[0]) ^ detail::plane_hash(cell[1] + j, key[1]);
        if constexpr (D == 2) {
            return detail::gradient_dot<Real>(word * 2246822519u, x[0] - i, x[1] - j);
        } else {
            word ^= detail::plane_hash(cell[2] + k, key[2]);
            return detail::gradient_dot<Real>(word * 2246822519u, x[0] - i, x[1] - j, x[2] - k);
        }
    };
    const auto face = [&](int k) {
        const Real u = detail::smooth<Real>(x[0]), v = detail::smooth<Real>(x[1]);
        return detail::mix<Real>(detail::mix<Real>(corner(0, 0, k), corner(1, 0, k), u),
                                 detail::mix<Real>(corner(0, 1, k), corner(1, 1, k), u), v);
    };
    if constexpr (D == 2) return face(0);
    return detail::mix<Real>(face(0), face(1), detail::smooth<Real>(x[D - 1]));
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

}  // namespace strata::oracle
