// An independent implementation of the gradient noise, from the written definitions of the lattice hash and the
// gradient sets. Shares no code with the project.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace strata::oracle {

namespace detail {

// SplitMix64's finaliser.
inline std::uint64_t scramble(std::uint64_t x) {
    x ^= x >> 30;
    x *= 13787848793156543929u;
    x ^= x >> 27;
    x *= 10723151780598845931u;
    x ^= x >> 31;
    return x;
}

// lowbias32.
inline std::uint32_t scramble(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 2146121005u;
    x = (x ^ (x >> 15)) * 2221713035u;
    return x ^ (x >> 16);
}

inline std::uint32_t plane_hash(std::int64_t index, std::uint32_t key) {
    const std::uint64_t shifted = static_cast<std::uint64_t>(index) + (std::uint64_t{1} << 31);
    const auto block = scramble(static_cast<std::uint32_t>(shifted >> 32) ^ key);
    const std::uint32_t x = static_cast<std::uint32_t>(shifted & 0xFFFFFFFFu) ^ block;
    const std::uint32_t product = (x ^ (x >> 16)) * 2654435761u;
    return product ^ (product >> 15);
}

// Eight directions: quarter turns of two near 22.5 and 67.5 degrees, whose components are 237/256 and 98/256.
constexpr std::array<std::array<double, 2>, 8> directions2() {
    std::array<std::array<double, 2>, 8> g{};
    g[0] = {237.0 / 256.0, 98.0 / 256.0};
    g[1] = {98.0 / 256.0, 237.0 / 256.0};
    for (std::size_t i = 2; i < 8; ++i) g[i] = {-g[i - 2][1], g[i - 2][0]};
    return g;
}

// The cube's twelve edge directions: four sign pairs on the axes (x, y), then on (x, z), then on (y, z), where bit 0
// negates the first of the pair and bit 1 the second. Numbers 12 to 15 repeat 0, 1, 9 and 11.
constexpr std::array<std::array<double, 3>, 16> directions3() {
    constexpr std::size_t kFirst[3] = {0, 0, 1}, kSecond[3] = {1, 2, 2};
    std::array<std::array<double, 3>, 16> g{};
    for (std::size_t i = 0; i < 12; ++i) {
        g[i][kFirst[i / 4]] = i & 1 ? -1.0 : 1.0;
        g[i][kSecond[i / 4]] = i & 2 ? -1.0 : 1.0;
    }
    g[12] = g[0], g[13] = g[1], g[14] = g[9], g[15] = g[11];
    return g;
}

inline constexpr auto kDirections2 = directions2();
inline constexpr auto kDirections3 = directions3();

// Dot product with the gradient that a corner's hash selects by its bits 24 and up.
template <class Real>
Real gradient_dot(std::uint32_t hash, Real x, Real y) {
    const auto& g = kDirections2[(hash >> 24) & 7u];
    return static_cast<Real>(g[0]) * x + static_cast<Real>(g[1]) * y;
}

template <class Real>
Real gradient_dot(std::uint32_t hash, Real x, Real y, Real z) {
    const auto& g = kDirections3[(hash >> 24) & 15u];
    return static_cast<Real>(g[0]) * x + static_cast<Real>(g[1]) * y + static_cast<Real>(g[2]) * z;
}

template <class Real>
Real smooth(Real t) {
    return ((6 * t - 15) * t + 10) * t * t * t;
}

template <class Real>
Real mix(Real a, Real b, Real weight) {
    return (1 - weight) * a + weight * b;
}

}  // namespace detail

template <class Real>
Real noise2(const std::array<std::uint32_t, 3>& key, Real x, Real y) {
    using namespace detail;
    const Real fx = std::floor(x), fy = std::floor(y);
    const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy);
    const std::uint32_t hx[2] = {plane_hash(ix, key[0]), plane_hash(ix + 1, key[0])};
    const std::uint32_t hy[2] = {plane_hash(iy, key[1]), plane_hash(iy + 1, key[1])};
    const auto corner = [&](int i, int j) {
        return gradient_dot<Real>((hx[i] ^ hy[j]) * 2246822519u, x - fx - static_cast<Real>(i),
                                  y - fy - static_cast<Real>(j));
    };
    const Real u = smooth(x - fx), v = smooth(y - fy);
    return mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v);
}

template <class Real>
Real noise3(const std::array<std::uint32_t, 3>& key, Real x, Real y, Real z) {
    using namespace detail;
    const Real fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
    const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy),
               iz = static_cast<std::int64_t>(fz);
    const std::uint32_t hx[2] = {plane_hash(ix, key[0]), plane_hash(ix + 1, key[0])};
    const std::uint32_t hy[2] = {plane_hash(iy, key[1]), plane_hash(iy + 1, key[1])};
    const std::uint32_t hz[2] = {plane_hash(iz, key[2]), plane_hash(iz + 1, key[2])};
    const auto corner = [&](int i, int j, int k) {
        return gradient_dot<Real>((hx[i] ^ hy[j] ^ hz[k]) * 2246822519u, x - fx - static_cast<Real>(i),
                                  y - fy - static_cast<Real>(j), z - fz - static_cast<Real>(k));
    };
    const Real u = smooth(x - fx), v = smooth(y - fy), w = smooth(z - fz);
    const auto slab = [&](int k) {
        return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
    };
    return mix(slab(0), slab(1), w);
}

}  // namespace strata::oracle
