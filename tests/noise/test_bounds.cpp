// The constants of bounds.h from below: attained within 1 %, never exceeded. From above: test_bounds_certificate.cpp.
#include "noise/bounds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "tests/noise/corner_series.h"

namespace {

using namespace strata::noise;
using namespace strata::noise::test;

std::array<double, kOrders> by_order(const NoiseBounds& b) { return {b.value, b.gradient, b.second, b.third}; }

template <int D>
std::array<double, kOrders> bounds() {
    return by_order(D == 2 ? kBounds2 : kBounds3);
}

// The largest derivative of order k along d at p that any choice of corner gradients gives.
template <int D>
double worst_case(std::size_t k, const std::array<double, D>& p, const std::array<double, D>& d) {
    double sum = 0.0;
    for (std::size_t c = 0; c < (1u << D); ++c) {
        const std::array<Series, D> series = corner_series<D>(p, d, c);
        double best = -1.0;
        for (std::size_t i = 0; i < kGradientCount<D>; ++i) {
            const std::array<double, D> g = gradient<D>(i);
            double dot = 0.0;
            for (std::size_t a = 0; a < D; ++a) dot += g[a] * series[a][k];
            best = std::max(best, dot);
        }
        sum += best;
    }
    return kFactorial[k] * sum;
}

// Climbs by random steps of shrinking length that stay in the closed cell.
template <int D>
double ascend(std::size_t k, Place<D> place, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    double best = worst_case<D>(k, place.p, place.d);
    for (double step = 0.1; step > 1e-8;) {
        bool improved = false;
        for (int attempt = 0; attempt < 24; ++attempt) {
            Place<D> trial = place;
            if (attempt % 3 != 0)
                for (double& x : trial.p) x = std::clamp(x + step * normal(random), 0.0, 1.0);
            if (attempt % 3 != 1)
                for (double& x : trial.d) x += step * normal(random);
            normalise<D>(trial.d);
            const double value = worst_case<D>(k, trial.p, trial.d);
            if (value > best) best = value, place = trial, improved = true;
        }
        if (!improved) step *= 0.5;
    }
    return best;
}

// The best of a grid of positions with random directions, then local ascent from each near-best one.
template <int D>
double maximise(std::size_t k) {
    std::mt19937_64 random(20060601 + k);
    std::normal_distribution<double> normal;
    constexpr std::size_t kPoints = D == 2 ? 17 : 9;  // an axis, faces included
    std::vector<std::pair<double, Place<D>>> starts;
    for (std::size_t point = 0; point < (D == 2 ? 1 : kPoints) * kPoints * kPoints; ++point) {
        Place<D> place;
        for (std::size_t a = 0, digits = point; a < D; ++a, digits /= kPoints)
            place.p[a] = static_cast<double>(digits % kPoints) / static_cast<double>(kPoints - 1);
        for (int attempt = 0; attempt < 12; ++attempt) {
            for (double& x : place.d) x = normal(random);
            normalise<D>(place.d);
            starts.emplace_back(worst_case<D>(k, place.p, place.d), place);
        }
    }
    constexpr std::ptrdiff_t kAscents = 40;
    std::partial_sort(starts.begin(), starts.begin() + kAscents, starts.end(),
                      [](const auto& a, const auto& b) { return a.first > b.first; });
    double best = 0.0;
    for (std::ptrdiff_t i = 0; i < kAscents; ++i) best = std::max(best, ascend<D>(k, starts[i].second, random));
    return best;
}

template <int D>
void check_maxima() {
    for (std::size_t k = 0; k < kOrders; ++k) {
        const double largest = maximise<D>(k);
        const double bound = bounds<D>()[k];
        MESSAGE(D << "-D, order " << k << ": largest found " << largest << ", of the bound " << largest / bound);
        CHECK(largest <= bound);
        CHECK(bound <= 1.001 * largest);
    }
}

template <int D>
struct Witness {
    Place<D> place;
    std::array<std::size_t, (1 << D)> gradients;  // indices of the corners' gradients
};

template <int D>
void check_witnesses(const std::array<Witness<D>, kOrders>& witnesses) {
    for (std::size_t k = 0; k < kOrders; ++k) {
        CornerGradients<D> gradients;
        for (std::size_t c = 0; c < gradients.size(); ++c) gradients[c] = gradient<D>(witnesses[k].gradients[c]);
        Place<D> place = witnesses[k].place;
        normalise<D>(place.d);
        const double attained = std::abs(along<D>(gradients, place)[k]);
        const double bound = bounds<D>()[k];
        MESSAGE(D << "-D, order " << k << ": witness attains " << attained << ", of the bound " << attained / bound);
        CHECK(attained <= bound);
        CHECK(bound <= 1.01 * attained);
    }
}

// Random starts, then each corner in turn takes the gradient that is worst for order k, and the place moves.
template <int D>
void attack() {
    std::mt19937_64 random(97);
    std::array<double, kOrders> largest{};
    double longest = 0.0;
    for (int trial = 0; trial < 4000; ++trial) {
        const std::size_t k = static_cast<std::size_t>(trial) % kOrders;
        CornerGradients<D> gradients = random_gradients<D>(random);
        Place<D> place = random_place<D>(random);
        double best = std::abs(along<D>(gradients, place)[k]);
        for (int step = 0; step < 30; ++step) {
            CornerGradients<D> trial_gradients = gradients;
            Place<D> trial_place = place;
            trial_gradients[random() % gradients.size()] = gradient<D>(random() % kGradientCount<D>);
            if (step % 3 == 0) trial_place = random_place<D>(random);
            const std::array<double, kOrders> found = along<D>(trial_gradients, trial_place);
            for (std::size_t order = 0; order < kOrders; ++order)
                largest[order] = std::max(largest[order], std::abs(found[order]));
            double squared = 0.0;
            for (const double x : interpolate<D>(trial_gradients, trial_place.p).gradient) squared += x * x;
            longest = std::max(longest, std::sqrt(squared));
            if (std::abs(found[k]) < best) continue;
            best = std::abs(found[k]);
            gradients = trial_gradients;
            place = trial_place;
        }
    }
    for (std::size_t k = 0; k < kOrders; ++k) {
        MESSAGE(D << "-D, order " << k << ": " << largest[k] / bounds<D>()[k] << " of the bound");
        CHECK(largest[k] <= bounds<D>()[k]);
        CHECK(largest[k] > 0.5 * bounds<D>()[k]);  // the attack is no feint
    }
    CHECK(longest <= bounds<D>()[1]);
}

}  // namespace

TEST_CASE("an ascent over positions and directions finds maxima within 0.1 % of the bounds, none above") {
    check_maxima<2>();
    check_maxima<3>();
}

TEST_CASE("explicit corner gradients attain every bound within 1 %") {
    check_witnesses<2>({{{{{0.5, 0.443731898}, {1, 0}}, {0, 3, 6, 5}},
                         {{{0.5, 0.5}, {-1, 0}}, {1, 6, 6, 1}},
                         {{{0.58888407, 0.694425327}, {0.843334689, 0.537388689}}, {1, 6, 4, 0}},
                         {{{0, 0.5}, {-1, 0}}, {1, 7, 5, 0}}}});
    check_witnesses<3>(
        {{{{{0.5, 0.644743306, 0.481492213}, {1, 0, 0}}, {0, 1, 4, 5, 10, 10, 6, 7}},
          {{{0.5, 0.5, 0.5}, {-1, 0, 0}}, {8, 11, 9, 10, 10, 9, 11, 8}},
          {{{0.600803674, 0.600803673, 0.5}, {-0.581622976, 0.581622972, -0.568708565}}, {7, 2, 4, 10, 9, 10, 1, 4}},
          {{{0, 0.455073701, 0.5}, {-1, 0, 0}}, {8, 6, 9, 0, 10, 4, 11, 0}}}});
}

TEST_CASE("random and adversarial gradients, positions and directions never exceed the bounds") {
    attack<2>();
    attack<3>();
}
