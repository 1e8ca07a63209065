// B-splines in exact integers, by truncated powers: (A.3) and (A.4) of Gamito & Maddock 2006. A double x >= 1 below 2^7
// is X / 2^52 with an integer X, so that
//
//   m! 2^(52 m) N_m(x) = sum over k of (-1)^k binomial(m,k) (X - k 2^52)_+^m
//
// and the same for (m-1)! n_m with the power m - 1: nothing is lost to cancellation at any order. Only the quotient by
// the factorial is rounded, to long double. Shares no code with the project.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace strata::oracle {

// A natural number below 2^6144: 100 factors below 2^60 fit.
class Natural {
  public:
    Natural(std::uint64_t value = 0) {
        limbs_[0] = static_cast<std::uint32_t>(value);
        limbs_[1] = static_cast<std::uint32_t>(value >> 32);
        size_ = 2;
        trim();
    }

    Natural& operator*=(std::uint64_t factor) {
        const std::uint64_t low = factor & 0xFFFFFFFFu, high = factor >> 32;
        const Natural shifted = high != 0 ? times(static_cast<std::uint32_t>(high)).up_one_limb() : Natural();
        *this = times(static_cast<std::uint32_t>(low));
        return *this += shifted;
    }

    Natural& operator+=(const Natural& other) {
        std::uint64_t carry = 0;
        const std::size_t size = std::max(size_, other.size_) + 1;
        for (std::size_t i = 0; i < size; ++i) {
            carry += std::uint64_t{limbs_[i]} + other.limbs_[i];
            limbs_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        size_ = size;
        trim();
        return *this;
    }

    // other <= *this.
    Natural& operator-=(const Natural& other) {
        std::int64_t borrow = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            borrow += std::int64_t{limbs_[i]} - std::int64_t{other.limbs_[i]};
            limbs_[i] = static_cast<std::uint32_t>(borrow & 0xFFFFFFFF);
            borrow >>= 32;
        }
        trim();
        return *this;
    }

    // times 2^exponent, to a few ulp.
    long double scaled(int exponent) const {
        long double top = 0.0L;
        const std::size_t used = std::min<std::size_t>(size_, 4);
        for (std::size_t i = 0; i < used; ++i) top = top * 0x1p32L + static_cast<long double>(limbs_[size_ - 1 - i]);
        return std::ldexp(top, exponent + 32 * static_cast<int>(size_ - used));
    }

  private:
    static constexpr std::size_t kLimbs = 192;

    void trim() {
        while (size_ > 1 && limbs_[size_ - 1] == 0) --size_;
    }

    Natural times(std::uint32_t factor) const {
        Natural product;
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i <= size_; ++i) {
            carry += std::uint64_t{limbs_[i]} * factor;
            product.limbs_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        product.size_ = size_ + 1;
        product.trim();
        return product;
    }

    Natural up_one_limb() const {
        Natural moved;
        for (std::size_t i = 0; i < size_; ++i) moved.limbs_[i + 1] = limbs_[i];
        moved.size_ = size_ + 1;
        return moved;
    }

    std::array<std::uint32_t, kLimbs> limbs_{};
    std::size_t size_ = 1;
};

struct ExactSpline {
    long double cdf = 0.0L;  // N_m
    long double pdf = 0.0L;  // n_m
};

namespace detail {

// sum over k of (-1)^k binomial(m,k) (X - k 2^52)_+^power / (2^(52 power) power!), power m - 1 or m: the m-th backward
// difference of a truncated power. All differences on the way are natural numbers too, being convolutions of truncated
// powers with lower splines.
inline long double truncated_powers(int m, int power, std::uint64_t X) {
    std::vector<Natural> term;
    for (int k = 0; k <= m && (static_cast<std::uint64_t>(k) << 52) <= X; ++k) {
        const std::uint64_t base = X - (static_cast<std::uint64_t>(k) << 52);
        Natural& product = term.emplace_back(1);
        for (int i = 0; i < power; ++i) product *= base;
    }
    for (int difference = 0; difference < m; ++difference) {
        for (std::size_t k = 0; k + 1 < term.size(); ++k) term[k] -= term[k + 1];
        if (term.size() > static_cast<std::size_t>(m - difference)) term.pop_back();
    }
    long double value = term.front().scaled(-52 * power);
    for (int k = 2; k <= power; ++k) value /= k;
    return value;
}

}  // namespace detail

// N_m and n_m at x in [0,m], to about 1e-18 relative.
inline ExactSpline exact_spline(int m, double x) {
    ExactSpline at;
    if (x < 1.0) {
        at.pdf = 1.0L;
        for (int k = 1; k < m; ++k) at.pdf *= static_cast<long double>(x) / k;
        at.cdf = at.pdf * static_cast<long double>(x) / m;
        return at;
    }
    const auto X = static_cast<std::uint64_t>(std::ldexp(x, 52));
    at.cdf = detail::truncated_powers(m, m, X);
    at.pdf = detail::truncated_powers(m, m - 1, X);
    return at;
}

}  // namespace strata::oracle
