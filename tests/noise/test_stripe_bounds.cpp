// The sums over a cell's corners that the stripe's certificates rest on (noise/relief/stripe.h), by branch and bound.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "noise/relief/stripe.h"

namespace {

using namespace strata::noise;

// The most that |u|, |u'|, |u''| and distances to 0 and 1 are between two places; u = 6 t^5 - 15 t^4 + 10 t^3.
struct Axis {
    double low, high;
    double rise, rest;  // of u and of 1 - u
    double slope, bend;
    double to_zero, to_one;
};

double largest(double low, double high, double (*of)(double), std::initializer_list<double> turning_points) {
    double most = std::max(std::abs(of(low)), std::abs(of(high)));
    for (const double t : turning_points) {
        if (low < t && t < high) most = std::max(most, std::abs(of(t)));
    }
    return most;
}

Axis axis(double low, double high) {
    const auto fade = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
    const double third = std::sqrt(3.0) / 6.0;
    return {
        low,
        high,
        fade(high),
        1.0 - fade(low),
        largest(low, high, [](double t) { return 30.0 * t * t * (1.0 - t) * (1.0 - t); }, {0.5}),
        largest(low, high, [](double t) { return 60.0 * t * (2.0 * t - 1.0) * (t - 1.0); }, {0.5 - third, 0.5 + third}),
        high,
        1.0 - low};
}

struct Sums {
    double slopes = 0.0, bends = 0.0, levers = 0.0;
};

Sums sums(const Axis& x, const Axis& z) {
    Sums all;
    for (const int corner : {0, 1, 2, 3}) {
        const bool right = corner % 2 == 1, far = corner / 2 == 1;
        const double a = right ? x.rise : x.rest, b = far ? z.rise : z.rest;
        const double gradient = std::hypot(x.slope * b, a * z.slope);
        all.slopes += gradient;
        all.bends +=
            std::sqrt(std::pow(x.bend * b, 2) + std::pow(a * z.bend, 2) + 2.0 * std::pow(x.slope * z.slope, 2));
        all.levers += gradient * std::hypot(right ? x.to_one : x.to_zero, far ? z.to_one : z.to_zero);
    }
    return all;
}

bool fits(const Sums& all) {
    return all.slopes <= kStripeSlopes && all.bends <= kStripeBends && all.levers <= kStripeLevers;
}

}  // namespace

TEST_CASE("no place of a cell has larger sums over its corners than the stripe's bounds say, which are tight") {
    std::vector<std::array<double, 4>> boxes{{0.0, 1.0, 0.0, 1.0}};
    Sums reached;
    std::size_t looked_at = 0;
    while (!boxes.empty()) {
        const auto [x0, x1, z0, z1] = boxes.back();
        boxes.pop_back();
        REQUIRE(++looked_at < 10'000'000);
        const double x = 0.5 * (x0 + x1), z = 0.5 * (z0 + z1);
        const Sums here = sums(axis(x, x), axis(z, z));
        REQUIRE(fits(here));
        reached = {std::max(reached.slopes, here.slopes), std::max(reached.bends, here.bends),
                   std::max(reached.levers, here.levers)};
        if (fits(sums(axis(x0, x1), axis(z0, z1)))) continue;
        for (const auto& half : {std::array{x0, x, z0, z}, {x, x1, z0, z}, {x0, x, z, z1}, {x, x1, z, z1}}) {
            boxes.push_back(half);
        }
    }
    MESSAGE(looked_at, " boxes; sums reached: ", reached.slopes, ", ", reached.bends, ", ", reached.levers);
    CHECK(reached.slopes > 0.99 * kStripeSlopes);
    CHECK(reached.bends > 0.99 * kStripeBends);
    CHECK(reached.levers > 0.99 * kStripeLevers);
}
