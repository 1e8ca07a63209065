// Reliefs in double: gradients, and certificates of the whole domain.
#include "noise/relief/relief.h"

#include <doctest/doctest.h>

#include <random>
#include <stdexcept>

#define STRATA_RELIEF_FORMULAS
#include <hwy/highway.h>

#include "noise/relief/curves-inl.h"
#include "noise/relief/hermite-inl.h"
#include "noise/relief/pits.h"
#include "noise/relief/steps-inl.h"
#include "noise/relief/stripe.h"
#include "tests/support/random.h"

namespace {

using namespace strata::noise;
using strata::support::uniform;

std::vector<std::vector<ReliefTerm>> general_reliefs() {
    Ridged ridged, sharp, even;
    sharp.roundness = 0.01;
    even.feedback = 0.0;
    Warp warp;
    warp.parameters.octaves = 2;
    Billow billow, cushions;
    billow.roundness = 0.02;
    cushions.feedback = 1.5;
    Hybrid hybrid;
    hybrid.turn_deg = 36.87;
    const ReliefTerm hills{"a", {}, Fbm{}}, peaks{"b", {}, ridged};
    return {{{"a", {}, billow}},
            {{"a", {}, cushions}},
            {{"a", {}, hybrid}},
            {hills, {"c", {"a"}, Curve{}}},
            {hills, {"c", {"a"}, Curve{{-0.3, -0.1, 0.0, 0.2}, {0.2, -0.2, 0.1, 0.1}}}},
            {hills, {"c", {"a"}, Terraces{}}},
            {hills, peaks, {"c", {"a", "b"}, Product{}}},
            {hills, peaks, {"c", {"a", "b"}, Blend{0.2, 0.5}}},
            {hills, peaks, {"c", {"b", "a", "a"}, Blend{0.1, -0.1}}},
            {hills, peaks, {"c", {"a", "b"}, Highest{}}},
            {hills, peaks, {"c", {"a", "b"}, Lowest{}}},
            {{"a", {}, Fbm{}}},
            {{"a", {}, ridged}},
            {{"a", {}, sharp}},
            {{"a", {}, even}},
            {{"a", {}, ridged}, {"b", {"a"}, warp}},
            {{"a", {}, Fbm{}}, {"b", {"a"}, warp}, {"c", {}, ridged}, {"d", {"b", "c"}, Sum{-0.5, 0.3}}}};
}

std::vector<std::vector<ReliefTerm>> landforms() {
    Gullies one;
    one.parameters.octaves = 1;
    Ridged ridged;
    ridged.parameters.octaves = 2;
    ridged.roundness = 0.2;
    Craters craters;
    craters.parameters.octaves = 2;
    craters.worn = 1.0;
    return {{{"a", {}, Ramp{.azimuth_deg = 30.0}}},
            {{"a", {}, Envelope{.x_size = 1e6, .lift = -1.0}}},
            {{"a", {}, Dunes{}}},
            {{"a", {}, craters}},
            {{"a", {}, Fbm{}}, {"b", {"a"}, Envelope{.x = 3.0, .lift = 0.4}}},
            {{"a", {}, Fbm{}}, {"b", {"a"}, Fill{}}},
            {{"a", {}, ridged}, {"b", {"a"}, one}},
            {{"a", {}, ridged}, {"b", {"a"}, Warp{}}, {"c", {"b"}, Gullies{}}}};
}

std::vector<std::vector<ReliefTerm>> reliefs(int dimensions) {
    std::vector<std::vector<ReliefTerm>> all = general_reliefs();
    if (dimensions == 3) return all;
    for (auto& terms : landforms()) all.push_back(terms);
    return all;
}

}  // namespace

TEST_CASE("a relief's gradient is the limit of its differences") {
    std::mt19937_64 random(1);
    for (const int dimensions : {2, 3}) {
        for (const auto& terms : reliefs(dimensions)) {
            const Relief relief(terms, dimensions);
            for (int i = 0; i < 200; ++i) {
                const glm::dvec3 x{uniform(random, -30, 30), uniform(random, -30, 30), uniform(random, -30, 30)};
                const ReliefJet jet = relief.jet(x);
                for (int a = 0; a < 3; ++a) {
                    glm::dvec3 step{0.0};
                    step[a] = 1e-6;
                    const double difference = (relief.jet(x + step).value - relief.jet(x - step).value) / 2e-6;
                    CHECK(jet.gradient[a] == doctest::Approx(difference).epsilon(1e-5).scale(10.0));
                }
            }
        }
    }
}

TEST_CASE("values, slopes and bends stay within a relief's certificate") {
    std::mt19937_64 random(2);
    for (const int dimensions : {2, 3}) {
        for (const auto& terms : reliefs(dimensions)) {
            const Relief relief(terms, dimensions);
            const Certificate& found = relief.certificate();
            double low = 1e9, high = -1e9, slope = 0.0, bend = 0.0;
            for (int i = 0; i < 4000; ++i) {
                const glm::dvec3 x{uniform(random, -99, 99), uniform(random, -99, 99), uniform(random, -99, 99)};
                const glm::dvec3 step = 1e-5 * glm::normalize(glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1),
                                                                         uniform(random, -1, 1)));
                const ReliefJet a = relief.jet(x), b = relief.jet(x + step);
                low = std::min(low, a.value);
                high = std::max(high, a.value);
                slope = std::max(slope, glm::length(a.gradient));
                bend = std::max(bend, glm::length(b.gradient - a.gradient) / glm::length(step));
            }
            MESSAGE(dimensions << "-D, " << terms.size() << " terms: range [" << low << ", " << high << "] of ["
                               << found.low << ", " << found.high << "], slope " << slope << " of " << found.slope
                               << ", bend " << bend << " of " << found.bend);
            CHECK(low >= found.low);
            CHECK(high <= found.high);
            CHECK(slope <= found.slope);
            CHECK(bend <= found.bend * (1 + 1e-3));
            CHECK(high - low > 0.15 * (found.high - found.low));
        }
    }
}

TEST_CASE("a curve's value, slope and bends stay within its bounds on any interval") {
    using namespace strata::noise::HWY_NAMESPACE;
    std::mt19937_64 random(3);
    const auto check = [&](const auto& curve, double from, double to) {
        double tightest = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const double a = uniform(random, from, to), b = uniform(random, from, to);
            const double lo = std::min(a, b), hi = std::max(a, b), v = uniform(random, lo, hi), h = 1e-6;
            const auto [least_value, most_value] = curve.range(lo, hi);
            REQUIRE(curve.value(v) >= least_value - 1e-12);
            REQUIRE(curve.value(v) <= most_value + 1e-12);
            REQUIRE(std::abs(curve.slope(v)) <= curve.steepest(lo, hi) + 1e-12);
            if constexpr (requires { curve.span(lo, hi); }) {
                REQUIRE(curve.value(v) >= curve.span(lo, hi).low - 1e-12);
                REQUIRE(curve.value(v) <= curve.span(lo, hi).high + 1e-12);
            }
            if (hi - lo < 3 * h) continue;
            const double at = std::clamp(v, lo + h, hi - h);
            const double second = (curve.slope(at + h) - curve.slope(at - h)) / (2 * h);
            REQUIRE(second <= curve.bend_up(lo, hi) + 1e-4);
            REQUIRE(-second <= curve.bend_down(lo, hi) + 1e-4 * curve.bend_down(lo, hi) + 1e-4);
            REQUIRE(curve.slope(at) ==
                    doctest::Approx((curve.value(at + h) - curve.value(at - h)) / (2 * h)).epsilon(1e-4));
            if (curve.bend_down(lo, hi) > 0.1) tightest = std::max(tightest, -second / curve.bend_down(lo, hi));
        }
        MESSAGE("bend down attained to " << tightest);
    };
    for (const double roundness : {0.01, 0.05, 0.3, 0.9}) check(RidgeCurve{roundness}, -1.0, 1.0);
    check(SoftClip{}, 0.0, 4.0);
    check(SoftClip{5.0}, 0.0, 1.0);
    check(FillCurve{0.2, 0.1}, -2.0, 2.0);
    check(FillCurve{-1.0, 0.01}, -2.0, 2.0);
    for (const double roundness : {0.02, 0.3}) check(BillowCurve{roundness, 1.2}, -1.0, 1.0);
    check(LiftCurve{}, -1.0, 1.0);
    check(SmoothStep{}, -0.5, 1.5);
    check(TerraceCurve{0.25, 0.8}, -1.0, 1.0);
    check(HermiteCurve{kPitProfile}, -0.1, 4.0);
    for (const auto& [from, to] : {std::pair{std::vector{-0.5, 0.0, 0.1, 0.5}, std::vector{-0.3, 0.0, 0.4, 0.6}},
                                   std::pair{std::vector{-0.5, 0.3, 0.4}, std::vector{0.3, 0.5, -0.4}}}) {
        Curve curve{from, to};
        curve.prepare();
        check(HermiteCurve{curve.table}, -1.0, 1.0);
    }
    for (const double lee : {0.2, 0.5}) {
        const HermiteTable profile = dune_profile(lee, 0.02);
        check(PeriodicCurve{{profile}}, -3.0, 3.0);
    }
}

TEST_CASE("a crater's profile stays within its bounds, and attains them") {
    using strata::noise::HWY_NAMESPACE::HermiteCurve;
    constexpr PitBounds of;
    const HermiteCurve g{kPitProfile};
    double low = 0.0, high = 0.0, slope = 0.0, up = 0.0, down = 0.0;
    for (double q = 1e-4; q < kPitReach * kPitReach + 0.1; q += 1e-4) {
        const double first = 2.0 * g.slope(q), h = 1e-6, second = (g.slope(q + h) - g.slope(q - h)) / (2.0 * h);
        low = std::min(low, g.value(q));
        high = std::max(high, g.value(q));
        slope = std::max(slope, std::sqrt(q) * std::abs(first));
        up = std::max({up, first, first + 4.0 * q * second});
        down = std::max({down, -first, -first - 4.0 * q * second});
    }
    for (const auto& [found, bound] :
         {std::pair{-low, -of.low}, {high, of.high}, {slope, of.slope}, {up, of.bend_up}, {down, of.bend_down}}) {
        CHECK(found <= bound);
        CHECK(found > 0.98 * bound);
    }
    CHECK(std::abs(g.value(kPitReach * kPitReach)) < 1e-12);
    CHECK(g.value(kPitReach * kPitReach + 0.01) == 0.0);
    CHECK(kPitReach * kWidest + kPitMargin <= 0.75);
}

TEST_CASE("no second derivative of a direction exceeds its bound") {
    std::mt19937_64 random(4);
    double most = 0.0;
    for (int i = 0; i < 200000; ++i) {
        const double c = 0.1, x = uniform(random, -1, 1), y = uniform(random, -1, 1), a = uniform(random, 0, 6.2832);
        const double h = 1e-4, dx = h * std::cos(a), dy = h * std::sin(a);
        const auto f = [&](double u, double v) { return u / std::sqrt(u * u + v * v + c * c); };
        const double second = (f(x + dx, y + dy) - 2 * f(x, y) + f(x - dx, y - dy)) / (h * h);
        most = std::max(most, std::abs(second) * (x * x + y * y + c * c));
    }
    MESSAGE("largest: " << most << " of " << kUnitBend);
    CHECK(most <= kUnitBend);
    CHECK(most > 0.5 * kUnitBend);
}

TEST_CASE("a relief of no terms, of an unknown name or of too many inputs is refused") {
    CHECK_THROWS_AS(Relief({}, 2), std::invalid_argument);
    const std::vector<ReliefTerm> unknown{{"a", {"b"}, Warp{}}};
    CHECK_THROWS_AS(Relief(unknown, 2), std::invalid_argument);
    const std::vector<ReliefTerm> crowded{{"a", {}, Fbm{}}, {"b", {"a"}, Fbm{}}};
    CHECK_THROWS_AS(Relief(crowded, 2), std::invalid_argument);
}

TEST_CASE("a curve rises from knot to knot where float can hardly tell its knots apart") {
    std::mt19937_64 random(11);
    for (int trial = 0; trial < 2000; ++trial) {
        Curve curve{{1.0}, {0.0}};
        while (curve.from.size() < 8) {
            curve.from.push_back(curve.from.back() + uniform(random, 0.7e-7, 4e-7));
            curve.to.push_back(curve.to.back() + uniform(random, 0.0, 1.0));
        }
        curve.prepare();
        if (!curve.problem().empty()) continue;
        const strata::noise::HWY_NAMESPACE::HermiteCurve drawn{curve.table};
        double before = drawn.value(curve.from.front());
        for (int i = 1; i <= 400; ++i) {
            const double v = curve.from.front() + i * (curve.from.back() - curve.from.front()) / 400.0;
            const double value = drawn.value(v);
            CHECK_MESSAGE(value >= before - 1e-6, trial, " ", i);
            before = value;
        }
    }
}
