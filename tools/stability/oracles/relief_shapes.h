// The shapes that relief terms are made of, from their written definitions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "noise/relief/relief.h"
#include "tools/stability/oracles/field_oracle.h"

namespace strata::oracle {

inline double hermite(double x0, double y0, double m0, double x1, double y1, double m1, double v) {
    const double w = x1 - x0, t = (v - x0) / w, u = 1.0 - t;
    return y0 * u * u * (1.0 + 2.0 * t) + y1 * t * t * (3.0 - 2.0 * t) + w * m0 * t * u * u - w * m1 * t * t * u;
}

// By Hermite's basis through knots at floats, their slopes by Fritsch and Butland.
inline double through_knots(const std::vector<float>& places, const std::vector<double>& y, double v) {
    const std::vector<double> x(places.begin(), places.end());
    const std::size_t last = x.size() - 1;
    const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
    const auto slope = [&](std::size_t i) {
        if (i == 0) return chord(0);
        if (i == last) return chord(last - 1);
        if (chord(i - 1) * chord(i) <= 0.0) return 0.0;
        const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i], w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
        return (w0 + w1) / (w0 / chord(i - 1) + w1 / chord(i));
    };
    if (v <= x.front()) return y.front() + slope(0) * (v - x.front());
    if (v >= x.back()) return y.back() + slope(last) * (v - x.back());
    std::size_t i = 0;
    while (v > x[i + 1]) ++i;
    return hermite(x[i], y[i], slope(i), x[i + 1], y[i + 1], slope(i + 1), v);
}

// The windward side, the slip face and its foot, with parabolas about the brink, between places that are floats.
inline double dune(double u, double lee, double brink) {
    const double w = 1.0 - lee, foot = 0.4 * lee, end = (w - brink) / w;
    const double before = end * end * (1.9 - 0.9 * end), rise = end * (3.8 - 2.7 * end) / w;
    const double top = before + 0.5 * rise * brink, fall = top / (lee - 0.5 * brink - 0.5 * foot);
    const double places[6] = {0.0, w - brink, w, w + brink, 1.0 - foot, 1.0};
    const double heights[6] = {0.0, before, top, top - 0.5 * fall * brink, 0.5 * foot * fall, 0.0};
    const double slopes[6] = {0.0, rise, 0.0, -fall, -fall, 0.0};
    int i = 0;
    while (i < 4 && u >= static_cast<float>(places[i + 1])) ++i;
    return hermite(static_cast<float>(places[i]), heights[i], slopes[i], static_cast<float>(places[i + 1]),
                   heights[i + 1], slopes[i + 1], u) /
           top;
}

inline double pit(double q) {
    static const std::vector<std::array<double, 3>> knots{
        {0.0, -0.263, 0.05},    {0.15, -0.2322, 0.36}, {0.88, 0.0306, 0.36}, {1.0, 0.0522, 0.0},
        {1.15, 0.0458, -0.085}, {1.6, 0.02, -0.038},   {2.4, 0.0055, -0.01}, {3.8025, 0.0, 0.0}};
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const auto &a = knots[i], &b = knots[i + 1];
        if (q < static_cast<float>(b[0])) {
            return hermite(static_cast<float>(a[0]), a[1], a[2], static_cast<float>(b[0]), b[1], b[2], q);
        }
    }
    return 0.0;
}

inline double mass_of(const noise::Envelope& node, const Vec& p) {
    return std::pow(1.0 + std::pow((p[0] - node.x) / node.x_size, 2.0) + std::pow((p[2] - node.z) / node.z_size, 2.0),
                    -2.0);
}

inline std::array<double, 2> stripe(const OracleOctave& o, const Vec& p, double dx, double dz, double bands) {
    const double x = o.frequency * p[0] + o.offset[0], z = o.frequency * p[2] + o.offset[1];
    const double cx = std::floor(x), cz = std::floor(z);
    std::array<double, 2> sum{};
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j < 2; ++j) {
            const std::uint32_t hash = (detail::plane_hash(static_cast<std::int64_t>(cx) + i, o.key[0]) ^
                                        detail::plane_hash(static_cast<std::int64_t>(cz) + j, o.key[1])) *
                                       2246822519u;
            const double u = detail::smooth(x - cx), v = detail::smooth(z - cz);
            const double weight = (i == 0 ? 1.0 - u : u) * (j == 0 ? 1.0 - v : v);
            const double turns = bands * (dx * (x - cx - i) + dz * (z - cz - j)) + (hash >> 8) / 16777216.0;
            sum[0] += weight * std::cos(6.283185307179586 * turns);
            sum[1] += weight * std::sin(6.283185307179586 * turns);
        }
    }
    return sum;
}

}  // namespace strata::oracle
