// Batches to evaluate noise on, with guards behind every output, and adversarial places.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "noise/noise.h"

namespace strata::noise::test {

inline constexpr float kGuard = 12345.678f;

template <std::size_t D>
using Offsets = std::array<std::vector<float>, D>;

template <std::size_t D>
std::size_t entry(std::size_t i, std::size_t j) {
    if (i > j) std::swap(i, j);
    if constexpr (D == 2) return i + j;
    return i == j ? i : 2 + i + j;
}

// Everything a batch gives, with guards after the end.
template <std::size_t D>
struct Output {
    std::vector<float> value;
    std::array<std::vector<float>, D> gradient;
    std::array<std::vector<float>, D*(D + 1) / 2> hessian;

    explicit Output(std::size_t count) : value(count + 1, kGuard) {
        for (auto& axis : gradient) axis.assign(count + 1, kGuard);
        for (auto& e : hessian) e.assign(count + 1, kGuard);
    }

    bool guarded() const {
        const auto kept = [](const std::vector<float>& v) { return v.back() == kGuard; };
        return kept(value) && std::all_of(gradient.begin(), gradient.end(), kept) &&
               std::all_of(hessian.begin(), hessian.end(), kept);
    }

    bool same_point(std::size_t i, const Output& other, std::size_t j) const {
        const auto same = [&](const std::vector<float>& a, const std::vector<float>& b) {
            return std::memcmp(&a[i], &b[j], sizeof(float)) == 0;
        };
        bool result = same(value, other.value);
        for (std::size_t a = 0; a < D; ++a) result = result && same(gradient[a], other.gradient[a]);
        for (std::size_t e = 0; e < hessian.size(); ++e) result = result && same(hessian[e], other.hessian[e]);
        return result;
    }
};

inline std::span<float> unguarded(std::vector<float>& v) { return std::span(v).first(v.size() - 1); }

// By all three entry points, whose values and gradients must be the same bits.
template <std::size_t D>
Output<D> evaluate(const LatticeKey& key, const std::array<std::int64_t, D>& base, const Offsets<D>& offsets) {
    const std::size_t count = offsets[0].size();
    Points<D> points{base, {}};
    Output<D> full(count), slopes(count), values(count);
    GradientSpans<D> full_gradient, slopes_gradient;
    HessianSpans<D> full_hessian;
    for (std::size_t a = 0; a < D; ++a) {
        points.offset[a] = offsets[a];
        full_gradient.axis[a] = unguarded(full.gradient[a]);
        slopes_gradient.axis[a] = unguarded(slopes.gradient[a]);
    }
    for (std::size_t e = 0; e < full.hessian.size(); ++e) full_hessian.entry[e] = unguarded(full.hessian[e]);
    noise_hessian(key, points, unguarded(full.value), full_gradient, full_hessian);
    noise_gradient(key, points, unguarded(slopes.value), slopes_gradient);
    noise_value(key, points, unguarded(values.value));
    CHECK(full.guarded());
    CHECK(slopes.guarded());
    CHECK(values.guarded());
    CHECK(values.value == full.value);
    CHECK(slopes.value == full.value);
    CHECK(slopes.gradient == full.gradient);
    return full;
}

// Base cells on both sides of every carry between an index's words, and far ones.
inline std::int64_t random_base(std::mt19937_64& random) {
    const std::int64_t block = std::int64_t{1} << 32;
    const std::array<std::int64_t, 7> magnitudes = {
        0, block / 2, block, 3 * block / 2, std::int64_t{1} << 40, (std::int64_t{1} << 51) - 64, std::int64_t{1} << 33};
    const std::int64_t at = magnitudes[random() % magnitudes.size()];
    const std::int64_t near = static_cast<std::int64_t>(random() % 9) - 4;
    return (random() % 2 ? at : -at) + near;
}

// Lattice planes, both neighbours of them, halves, tiny, small and large offsets.
inline float random_offset(std::mt19937_64& random) {
    const float sign = random() % 2 ? 1.0f : -1.0f;
    const float whole = static_cast<float>(random() % 8);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    switch (random() % 10) {
        case 0:
            return sign * whole;
        case 1:
            return std::nextafter(sign * whole, 100.0f);
        case 2:
            return std::nextafter(sign * whole, -100.0f);
        case 3:
            return sign * (whole + 0.5f);
        case 4:
            return sign * std::ldexp(unit(random), -static_cast<int>(random() % 100));
        case 5:
            return sign * 8388608.0f * unit(random);
        case 6:
            return sign * 4096.0f * unit(random);
        default:
            return sign * 4.0f * unit(random);
    }
}

template <std::size_t D>
struct Case {
    LatticeKey key;
    std::array<std::int64_t, D> base;
    Offsets<D> offsets;
};

template <std::size_t D>
Case<D> random_case(std::size_t count, std::mt19937_64& random) {
    Case<D> c;
    c.key = lattice_key(random(), static_cast<int>(random() % 32));
    const bool far = random() % 2;
    for (std::size_t a = 0; a < D; ++a) {
        c.base[a] = far ? random_base(random) : static_cast<std::int64_t>(random() % 9) - 4;
        for (std::size_t i = 0; i < count; ++i) c.offsets[a].push_back(random_offset(random));
    }
    return c;
}

}  // namespace strata::noise::test
