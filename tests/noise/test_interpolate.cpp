#include "noise/interpolate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "tests/noise/corner_series.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

constexpr std::array<double, kOrders> kScale = {1.0, 3.0, 10.0, 100.0};  // about the largest derivative of each order

template <int D>
void check_interpolation() {
    std::mt19937_64 random(11);
    double worst = 0.0;
    for (int trial = 0; trial < 20000; ++trial) {
        const CornerGradients<D> gradients = random_gradients<D>(random);
        const Place<D> place = random_place<D>(random);
        Series expected{};
        for (std::size_t c = 0; c < gradients.size(); ++c) {
            const std::array<Series, D> series = corner_series<D>(place.p, place.d, c);
            for (std::size_t a = 0; a < D; ++a)
                for (std::size_t k = 0; k < kOrders; ++k) expected[k] += kFactorial[k] * gradients[c][a] * series[a][k];
        }
        const std::array<double, kOrders> found = along<D>(gradients, place);
        for (std::size_t k = 0; k < kOrders; ++k) worst = std::max(worst, std::abs(found[k] - expected[k]) / kScale[k]);
    }
    MESSAGE(D << "-D: largest error " << worst << " of the bounds");
    CHECK(worst < 1e-14);
}

// Two cells that share the face x_0 = 1 of the first; the corners off the face are independent.
template <int D>
void check_continuity() {
    std::mt19937_64 random(12);
    double worst = 0.0;
    for (int trial = 0; trial < 20000; ++trial) {
        const CornerGradients<D> left = random_gradients<D>(random);
        CornerGradients<D> right = random_gradients<D>(random);
        for (std::size_t c = 0; c < left.size(); c += 2) right[c] = left[c + 1];
        Place<D> place = random_place<D>(random);
        place.p[0] = 1.0;
        const std::array<double, kOrders> before = along<D>(left, place);
        place.p[0] = 0.0;
        const std::array<double, kOrders> after = along<D>(right, place);
        for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(before[k] - after[k]) / kScale[k]);
    }
    MESSAGE(D << "-D: largest jump " << worst);
    CHECK(worst < 1e-14);
}

}  // namespace

TEST_CASE("value, gradient, Hessian and third derivative agree with the Taylor series of the definition") {
    check_interpolation<2>();
    check_interpolation<3>();
}

TEST_CASE("value, slope and curvature are continuous across cells") {
    check_continuity<2>();
    check_continuity<3>();
}
