// Noise and soft ranges as samples see them that cover some ground.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "noise/bounds.h"
#include "noise/reference.h"
#include "shaders_cpu/filtered_noise.h"
#include "shaders_cpu/soft_range.h"

using namespace strata;
using namespace strata::shaders;

namespace {

struct RandomPoint {
    std::mt19937_64 random;
    glm::dvec3 operator()() {
        std::uniform_real_distribution<double> anywhere(-1000.0, 1000.0);
        return {anywhere(random), anywhere(random), anywhere(random)};
    }
};

// A point of a square of the given side about x, level.
glm::dvec3 within(const glm::dvec3& x, double side, std::mt19937_64& random) {
    std::uniform_real_distribution<double> u(-0.5, 0.5);
    return x + side * glm::dvec3(u(random), 0.0, u(random));
}

}  // namespace

TEST_CASE("the mean squares of noise and gradient are as stated") {
    const noise::Octave octave = noise::make_octaves({.octaves = 1, .seed = 77})[0];
    RandomPoint point{std::mt19937_64(1)};
    double value2 = 0.0, gradient2 = 0.0;
    constexpr int kPoints = 400'000;
    for (int i = 0; i < kPoints; ++i) {
        const glm::dvec3 p = point();
        const auto jet = noise::reference_jet<3>(octave.key, noise::split_position<3>({p.x, p.y, p.z}));
        value2 += jet.value * jet.value;
        for (const double d : jet.gradient) gradient2 += d * d;
    }
    CHECK(value2 / kPoints == doctest::Approx(kMeanNoise2).epsilon(0.01));
    CHECK(gradient2 / kPoints == doctest::Approx(kMeanGradient2).epsilon(0.01));
}

TEST_CASE("at footprint 0 the noise is its sum of octaves, of mean 0 and mean square 1, within most()") {
    for (const double gain : {0.3, 0.55, 1.0}) {
        const FilteredNoise noise({.octaves = 4, .gain = gain, .seed = 9});
        // By the definition: octaves of lacunarity 2, over the root of the sum of their mean squares.
        double total = 0.0;
        for (int k = 0; k < 4; ++k) total += std::pow(gain, 2 * k);
        const auto octaves = noise::make_octaves({.octaves = 4, .lacunarity = 2.0, .gain = gain, .seed = 9});
        RandomPoint point{std::mt19937_64(2)};
        double mean = 0.0, square = 0.0, worst = 0.0, most = 0.0;
        constexpr int kPoints = 200'000;
        for (int i = 0; i < kPoints; ++i) {
            const glm::dvec3 p = point();
            const FilteredValue seen = noise(p, 0.0);
            if (i < 1000) {
                double sum = 0.0;
                for (const noise::Octave& o : octaves) {
                    const noise::Point<3> at{o.frequency * p.x + o.offset[0], o.frequency * p.y + o.offset[1],
                                             o.frequency * p.z + o.offset[2]};
                    sum += o.amplitude * noise::reference_value<3>(o.key, noise::split_position<3>(at));
                }
                worst = std::max(worst, std::abs(seen.value - sum / std::sqrt(kMeanNoise2 * total)));
            }
            CHECK(seen.variance == 0.0);
            mean += seen.value;
            square += seen.value * seen.value;
            most = std::max(most, std::abs(seen.value));
        }
        CHECK(worst < 1e-12);
        CHECK(std::abs(mean / kPoints) < 0.01);
        CHECK(square / kPoints == doctest::Approx(1.0).epsilon(0.02));
        CHECK(most < noise.most());
    }
}

TEST_CASE("what the value loses with the footprint is told as variance: together they stay 1") {
    const FilteredNoise noise({.octaves = 5, .gain = 0.6, .seed = 3});
    for (const double footprint : {0.01, 0.03, 0.1, 0.3, 1.0, 10.0}) {
        RandomPoint point{std::mt19937_64(4)};
        double square = 0.0;
        constexpr int kPoints = 100'000;
        for (int i = 0; i < kPoints; ++i) square += std::pow(noise(point(), footprint).value, 2.0);
        const double variance = noise(point(), footprint).variance;
        CAPTURE(footprint);
        CHECK(variance >= 0.0);
        CHECK(variance <= 1.0);
        // Octaves that are still whole vary inside of the footprint, too: at most a tenth, counted twice.
        CHECK(square / kPoints + variance >= 0.97);
        CHECK(square / kPoints + variance <= 1.1);
        if (footprint >= 1.0) CHECK(square == 0.0);
    }
}

TEST_CASE("values of neighbouring pixels differ little, where without the footprint they would be strangers") {
    // Fractal noise whose octaves are all alike: white noise to a pixel that covers all of them.
    const FilteredNoise noise({.octaves = 10, .gain = 1.0, .seed = 5});
    for (const double pixel : {0.01, 0.04, 0.3, 2.0}) {
        RandomPoint point{std::mt19937_64(6)};
        double filtered = 0.0, unfiltered = 0.0;
        constexpr int kPoints = 20'000;
        for (int i = 0; i < kPoints; ++i) {
            const glm::dvec3 p = point(), q = p + glm::dvec3(pixel, 0.0, 0.0);
            filtered += std::pow(noise(p, pixel).value - noise(q, pixel).value, 2.0);
            unfiltered += std::pow(noise(p, 0.0).value - noise(q, 0.0).value, 2.0);
        }
        CAPTURE(pixel);
        MESSAGE("root mean square of neighbours' difference: ", std::sqrt(filtered / kPoints),
                ", without: ", std::sqrt(unfiltered / kPoints));
        // Two points q cells apart differ in an octave of mean square v by at most v min(q^2 kMeanGradient2 / 3 /
        // kMeanNoise2, 2) = v min(6.81 q^2, 2) in the mean of squares. Of octaves of which each is twice as fine, one
        // fades, 0.5 < q < 1, with the square of its share, and those that are coarser add 6.81 (q/2)^2 (1 + 1/4 +
        // ...): at most 2.6 v, near q = 0.55. Here v is a tenth.
        CHECK(std::sqrt(filtered / kPoints) < std::sqrt(2.6 / 10.0));
    }
}

TEST_CASE("a soft range is in [0,1], 1 well inside, half at its ends, continuous") {
    const SmoothRange range({-1.0, 2.0, 0.5}, -10.0, 10.0);
    CHECK(range(0.5, 0.0) == 1.0);
    CHECK(range(-1.0, 0.0) == doctest::Approx(0.5));
    CHECK(range(2.0, 0.0) == doctest::Approx(0.5));
    CHECK(range(-1.25, 0.0) == 0.0);
    CHECK(range(2.25, 0.0) == 0.0);
    // The steepest slope of a cubic step over a width w is 1.5 / w.
    constexpr double kStep = 1e-3;
    for (double x = -3.0; x < 4.0; x += kStep) {
        for (const double variance : {0.0, 0.01, 4.0}) {
            const double here = range(x, variance);
            REQUIRE(here >= 0.0);
            REQUIRE(here <= 1.0);
            REQUIRE(std::abs(range(x + kStep, variance) - here) <= 1.5 / 0.5 * kStep * (1.0 + 1e-9));
        }
    }
}

TEST_CASE("ends at the ends of what is allowed are none") {
    const SmoothRange all({-10.0, 10.0, 5.0}, -10.0, 10.0);
    CHECK(all.is_everything());
    for (const double x : {-1e9, -10.0, 0.0, 10.0, 1e9}) CHECK(all(x, 7.0) == 1.0);
    const SmoothRange above({3.0, 10.0, 1.0}, -10.0, 10.0);
    CHECK(!above.is_everything());
    CHECK(above(1e12, 0.0) == 1.0);
    CHECK(above(0.0, 0.0) == 0.0);
}

TEST_CASE("where a range is told to be nothing near, it is") {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    int nothing = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double from = 4.0 * u(random) - 2.0;
        const SmoothRange range({from, from + 3.0 * u(random) + 1e-9, u(random) + 1e-6}, -100.0, 100.0);
        const double mean = 20.0 * u(random) - 10.0, reach = 3.0 * u(random), variance = u(random);
        if (!range.is_nothing_near(mean, reach, variance)) continue;
        ++nothing;
        REQUIRE(range(mean + reach * (2.0 * u(random) - 1.0), variance * u(random)) == 0.0);
    }
    CHECK(nothing > 10'000);
}

TEST_CASE("the mean of a mask over the ground is the same for every footprint") {
    // Patches of a noise with hard edges, seen ever coarser: their share stays.
    const FilteredNoise noise({.octaves = 6, .gain = 0.6, .seed = 12});
    for (const double from : {-0.5, 0.0, 0.7, 1.5}) {
        const SmoothRange patches({from, 100.0, 0.05}, -100.0, 100.0);
        double exact = 0.0;
        for (const double footprint : {0.0, 0.02, 0.1, 0.3, 1.0, 50.0}) {
            RandomPoint point{std::mt19937_64(13)};
            double sum = 0.0;
            constexpr int kPoints = 60'000;
            for (int i = 0; i < kPoints; ++i) {
                const FilteredValue seen = noise(point(), footprint);
                sum += patches(seen.value, seen.variance);
            }
            const double mean = sum / kPoints;
            if (footprint == 0.0) exact = mean;
            CAPTURE(from);
            CAPTURE(footprint);
            CHECK(std::abs(mean - exact) < 0.03);
        }
    }
}

TEST_CASE("a mask seen through a footprint is near the mean of the mask over that footprint") {
    const FilteredNoise noise({.octaves = 6, .gain = 0.5, .seed = 21});
    const SmoothRange patches({0.3, 100.0, 0.2}, -100.0, 100.0);
    std::mt19937_64 random(22);
    for (const double footprint : {0.03, 0.1, 0.4}) {
        RandomPoint point{std::mt19937_64(23)};
        double seen_error = 0.0, point_error = 0.0;
        constexpr int kPoints = 1000, kInside = 256;
        for (int i = 0; i < kPoints; ++i) {
            const glm::dvec3 p = point();
            double mean = 0.0;
            for (int j = 0; j < kInside; ++j) mean += patches(noise(within(p, footprint, random), 0.0).value, 0.0);
            mean /= kInside;
            const FilteredValue seen = noise(p, footprint);
            seen_error += std::pow(patches(seen.value, seen.variance) - mean, 2.0);
            point_error += std::pow(patches(noise(p, 0.0).value, 0.0) - mean, 2.0);
        }
        CAPTURE(footprint);
        MESSAGE("root mean square from the footprint's mean: ", std::sqrt(seen_error / kPoints),
                ", of a point sample: ", std::sqrt(point_error / kPoints));
        CHECK(seen_error < point_error);
    }
}
