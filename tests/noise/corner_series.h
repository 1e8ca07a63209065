// Gradient noise along a line as truncated Taylor series, from its definition, for tests; and random places to test at.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "noise/gradients.h"
#include "noise/interpolate.h"

namespace strata::noise::test {

constexpr std::size_t kOrders = 4;

template <int D>
constexpr std::size_t kGradientCount = D == 2 ? kGradients2.size() : kGradients3.size();

template <int D>
std::array<double, D> gradient(std::size_t i) {
    std::array<double, D> g;
    for (std::size_t a = 0; a < D; ++a) {
        if constexpr (D == 2) {
            g[a] = kGradients2[i][a];
        } else {
            g[a] = kGradients3[i][a];
        }
    }
    return g;
}

// Taylor polynomial in s, truncated after s^3.
using Series = std::array<double, kOrders>;

inline Series operator*(const Series& a, const Series& b) {
    Series product{};
    for (std::size_t i = 0; i < kOrders; ++i)
        for (std::size_t j = 0; i + j < kOrders; ++j) product[i + j] += a[i] * b[j];
    return product;
}

inline Series fade_series(const Series& t) {
    Series inner = t;
    for (double& x : inner) x *= 6.0;
    inner[0] -= 15.0;
    inner = inner * t;
    inner[0] += 10.0;
    return inner * t * t * t;
}

// One corner's W_c(p + s d) (p + s d - c), a series for each component.
template <int D>
std::array<Series, D> corner_series(const std::array<double, D>& p, const std::array<double, D>& d, std::size_t c) {
    Series weight{1.0};
    for (std::size_t a = 0; a < D; ++a) {
        Series w = fade_series({p[a], d[a]});
        if (((c >> a) & 1) == 0) {
            for (double& x : w) x = -x;
            w[0] += 1.0;
        }
        weight = weight * w;
    }
    std::array<Series, D> result;
    for (std::size_t a = 0; a < D; ++a) result[a] = weight * Series{p[a] - static_cast<double>((c >> a) & 1), d[a]};
    return result;
}

constexpr std::array<double, kOrders> kFactorial = {1.0, 1.0, 2.0, 6.0};

template <int D>
void normalise(std::array<double, D>& d) {
    double squared = 0.0;
    for (const double x : d) squared += x * x;
    for (double& x : d) x /= std::sqrt(squared);
}

template <int D>
struct Place {
    std::array<double, D> p;
    std::array<double, D> d;
};

// d^3/ds^3 n(f + s d) at s = 0, on the side of a cell face that f's own cell is on.
template <int D>
double third_directional(const CornerGradients<D>& gradients, const Point<D>& fraction,
                         const std::array<double, D>& d) {
    const CornerWeights<D> weights(fraction);
    double sum = 0.0;
    for (std::size_t c = 0; c < gradients.size(); ++c) {
        double along = 0.0;
        double weight_second = 0.0;
        double weight_third = 0.0;
        for (std::size_t i = 0; i < D; ++i) {
            along += gradients[c][i] * d[i];
            for (std::size_t j = 0; j < D; ++j) {
                std::array<std::size_t, D> orders{};
                ++orders[i];
                ++orders[j];
                weight_second += weights.derivative(c, orders) * d[i] * d[j];
                for (std::size_t k = 0; k < D; ++k) {
                    std::array<std::size_t, D> third = orders;
                    ++third[k];
                    weight_third += weights.derivative(c, third) * d[i] * d[j] * d[k];
                }
            }
        }
        sum += 3.0 * weight_second * along + weight_third * corner_ramp<D>(gradients[c], fraction, c);
    }
    return sum;
}

// The derivatives of order 0..3 along d that the interpolation gives.
template <int D>
std::array<double, kOrders> along(const CornerGradients<D>& gradients, const Place<D>& place) {
    const Jet<D> jet = interpolate<D>(gradients, place.p);
    std::array<double, kOrders> result = {jet.value, 0.0, 0.0, third_directional<D>(gradients, place.p, place.d)};
    for (std::size_t i = 0; i < D; ++i) {
        result[1] += place.d[i] * jet.gradient[i];
        for (std::size_t j = 0; j < D; ++j) result[2] += place.d[i] * jet.hessian[i][j] * place.d[j];
    }
    return result;
}

template <int D>
CornerGradients<D> random_gradients(std::mt19937_64& random) {
    CornerGradients<D> gradients;
    for (auto& g : gradients) g = gradient<D>(random() % kGradientCount<D>);
    return gradients;
}

// A position in the cell, often on a face, an edge or half way, and a direction, often along an axis or a diagonal.
template <int D>
Place<D> random_place(std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::normal_distribution<double> normal;
    Place<D> place;
    for (double& x : place.p) x = random() % 4 == 0 ? static_cast<double>(random() % 3) / 2.0 : uniform(random);
    do {
        for (double& x : place.d) x = random() % 4 == 0 ? static_cast<double>(random() % 3) - 1.0 : normal(random);
    } while (std::all_of(place.d.begin(), place.d.end(), [](double x) { return x == 0.0; }));
    normalise<D>(place.d);
    return place;
}

}  // namespace strata::noise::test
