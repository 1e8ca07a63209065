// Gradient noise inside one lattice cell, in scalar double: the definition that every faster version is measured by.
//
//   n(f) = sum over corners c in {0,1}^D of W_c(f) g_c . (f - c),   W_c(f) = prod over axes a of w_{c_a}(f_a),
//   w_1(t) = fade(t) = t^3 (6 t^2 - 15 t + 10),   w_0(t) = 1 - fade(t)        (K. Perlin, "Improving Noise", 2002).
//
// f in [0,1]^D is the position in the cell, in lattice units; bit a of a corner's index says that it lies at +1 along
// axis a. The quintic fade has zero slope and curvature at 0 and 1, so across cells n is twice continuously
// differentiable; the third derivative jumps. Rounding error of values and derivatives: a few ulp of sum |g_c|.
#pragma once

#include <array>
#include <cstddef>

namespace strata::noise {

template <int D>
using Point = std::array<double, D>;

template <int D>
using CornerGradients = std::array<std::array<double, D>, (1 << D)>;

template <int D>
struct Jet {
    double value = 0.0;
    std::array<double, D> gradient{};
    std::array<std::array<double, D>, D> hessian{};  // symmetric
};

constexpr double fade(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }

// Derivatives of w_0 (side 0) and w_1 (side 1) at t, by order.
constexpr std::array<double, 4> fade_derivatives(std::size_t side, double t) {
    const double s = t * (1.0 - t);
    const std::array<double, 4> up = {fade(t), 30.0 * s * s, 60.0 * s * (1.0 - 2.0 * t), 60.0 * (1.0 - 6.0 * s)};
    return side == 1 ? up : std::array<double, 4>{1.0 - up[0], -up[1], -up[2], -up[3]};
}

// Weights of the corners and their partial derivatives, at one position in the cell.
template <int D>
class CornerWeights {
  public:
    explicit CornerWeights(const Point<D>& fraction) {
        for (std::size_t a = 0; a < D; ++a) {
            for (std::size_t side = 0; side < 2; ++side) axis_[a][side] = fade_derivatives(side, fraction[a]);
        }
    }

    // d^|orders| W_c / prod dx_a^orders[a], each order 0..3.
    double derivative(std::size_t corner, const std::array<std::size_t, D>& orders) const {
        double product = 1.0;
        for (std::size_t a = 0; a < D; ++a) product *= axis_[a][(corner >> a) & 1][orders[a]];
        return product;
    }

  private:
    std::array<std::array<std::array<double, 4>, 2>, D> axis_;
};

// The linear function that a corner contributes: g . (f - corner).
template <int D>
double corner_ramp(const std::array<double, D>& gradient, const Point<D>& fraction, std::size_t corner) {
    double dot = 0.0;
    for (std::size_t a = 0; a < D; ++a) dot += gradient[a] * (fraction[a] - static_cast<double>((corner >> a) & 1));
    return dot;
}

// n(f) from the corners' ramps, by nested linear interpolation: along axis 0 first.
template <int D>
double interpolate_ramps(std::array<double, (1 << D)> ramp, const Point<D>& fraction) {
    for (std::size_t a = 0, pairs = ramp.size() / 2; a < D; ++a, pairs /= 2) {
        const double weight = fade(fraction[a]);
        for (std::size_t i = 0; i < pairs; ++i) ramp[i] = ramp[2 * i] + weight * (ramp[2 * i + 1] - ramp[2 * i]);
    }
    return ramp[0];
}

// n(f), its gradient and its Hessian, by the product rule, in lattice units.
template <int D>
Jet<D> interpolate(const CornerGradients<D>& gradients, const Point<D>& fraction) {
    const CornerWeights<D> weights(fraction);
    Jet<D> jet;
    for (std::size_t c = 0; c < gradients.size(); ++c) {
        const double ramp = corner_ramp<D>(gradients[c], fraction, c);
        const double weight = weights.derivative(c, {});
        std::array<double, D> slope;
        for (std::size_t i = 0; i < D; ++i) {
            std::array<std::size_t, D> orders{};
            orders[i] = 1;
            slope[i] = weights.derivative(c, orders);
        }
        jet.value += weight * ramp;
        for (std::size_t i = 0; i < D; ++i) {
            jet.gradient[i] += weight * gradients[c][i] + slope[i] * ramp;
            for (std::size_t j = 0; j < D; ++j) {
                std::array<std::size_t, D> orders{};
                ++orders[i];
                ++orders[j];
                jet.hessian[i][j] +=
                    slope[i] * gradients[c][j] + slope[j] * gradients[c][i] + weights.derivative(c, orders) * ramp;
            }
        }
    }
    return jet;
}

}  // namespace strata::noise
