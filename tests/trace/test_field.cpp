// The field against an independent implementation, and the bounds and intervals that tracing relies on.
#include "src/trace/field.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/surfaces.h"
#include "tests/trace/ray_families.h"

using namespace strata;
using namespace strata::trace_test;

namespace {

oracle::Vec vec(const glm::dvec3& x) { return {x.x, x.y, x.z}; }

glm::dvec3 anywhere(Random& random, double reach) {
    return reach * glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
}

// Rounding of f at x in double: of the base and of the sum after each octave, of each octave's position in its lattice,
// of each octave's value.
double rounding(const trace::Field& field, const glm::dvec3& x) {
    const double sums = 4.0 + static_cast<double>(field.octaves().size());
    double sum = sums * (glm::length(x) + std::abs(field.base(glm::dvec3(0.0))) + field.amplitude());
    for (const noise::Octave& octave : field.octaves()) {
        sum += octave.amplitude * (16.0 + 16.0 * (octave.frequency * glm::length(x) + 1.0));
    }
    return sum * 0x1p-53;
}

// Climbs `score` from x by random steps.
glm::dvec3 climb(Random& random, glm::dvec3 x, double step, const std::function<double(const glm::dvec3&)>& score) {
    double best = score(x);
    for (int i = 0; i < 60; ++i, step *= 0.95) {
        const glm::dvec3 y = x + step * unit_vector(random);
        const double there = score(y);
        if (there <= best) continue;
        best = there;
        x = y;
    }
    return x;
}

}  // namespace

TEST_CASE("value, base and every octave agree with the oracle") {
    Random random(11);
    double worst = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
        scene::Surface surface = random_surface(random);
        surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
        const trace::Field field(surface);
        const oracle::FieldOracle expected(shape_of(surface));
        REQUIRE(field.octaves().size() == expected.octaves().size());
        for (int i = 0; i < 10; ++i) {
            const glm::dvec3 x = anywhere(random, log_uniform(random, 1e-3, 1e5));
            const double bound = rounding(field, x);
            double error = std::abs(field.value(x) - static_cast<double>(expected.value<long double>(vec(x))));
            error = std::max(error, std::abs(field.base(x) - static_cast<double>(expected.base<long double>(vec(x)))));
            for (std::size_t k = 0; k < field.octaves().size(); ++k) {
                const auto octave = static_cast<double>(expected.octave<long double>(k, vec(x)));
                error = std::max(error, std::abs(field.octave(k, x) - octave));
            }
            worst = std::max(worst, error / bound);
        }
    }
    MESSAGE("largest difference " << worst << " of the rounding bound");
    CHECK(worst <= 1.0);
    CHECK(worst > 0.0);
}

TEST_CASE("octaves that cannot change a double are left out, and the sum stays the same") {
    Random random(12);
    scene::Surface surface = surface_of(solid::kKind<solid::DisplacedPlane>);
    surface.octaves = 32;
    surface.lacunarity = 1.2;
    for (const double gain : {0.0, 1e-3, 0.1, 0.15}) {
        surface.gain = gain;
        const trace::Field field(surface);
        const oracle::FieldOracle expected(shape_of(surface));
        CHECK(field.octaves().size() < 32);
        CHECK(!field.octaves().empty());
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 x = anywhere(random, 20.0);
            CHECK(std::abs(field.value(x) - expected.value(vec(x))) <= rounding(field, x));
        }
    }
    surface.amplitude = 0.0;
    const trace::Field flat(surface);
    CHECK(flat.octaves().empty());
    CHECK(flat.amplitude() == 0.0);
    CHECK(flat.lipschitz() == 1.0);
    CHECK(flat.value({3.0, -2.5, 7.0}) == -2.5);
}

TEST_CASE("the gradient agrees with central differences of the oracle in extended precision") {
    Random random(13);
    double worst = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
        scene::Surface surface = random_surface(random);
        surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
        const trace::Field field(surface);
        const oracle::FieldOracle expected(shape_of(surface));
        const glm::dvec3 x = anywhere(random, 6.0);
        // Central differences are exact for planes and level sets, and for spheres as far as 1e-6 counts here.
        glm::dvec3 gradient;
        for (int a = 0; a < 3; ++a) {
            glm::dvec3 up = x, down = x;
            up[a] += 0x1p-12, down[a] -= 0x1p-12;
            const long double rise = expected.base<long double>(vec(up)) - expected.base<long double>(vec(down));
            gradient[a] = static_cast<double>(rise / 0x1p-11L);
        }
        double slopes = 1.0;
        for (std::size_t k = 0; k < expected.octaves().size(); ++k) {
            const oracle::OracleOctave& octave = expected.octaves()[k];
            slopes += octave.amplitude * octave.frequency;
            for (int a = 0; a < 3; ++a) {
                glm::dvec3 before = x, after = x;
                before[a] -= 0x1p-14 / octave.frequency;
                after[a] += 0x1p-14 / octave.frequency;
                const long double rise =
                    expected.octave<long double>(k, vec(after)) - expected.octave<long double>(k, vec(before));
                gradient[a] -= static_cast<double>(rise / (static_cast<long double>(after[a]) - before[a]));
            }
        }
        worst = std::max(worst, glm::length(field.gradient(x) - gradient) / slopes);
    }
    // The difference's own error: third derivative * h^2 / 6 < 1e-7, and rounding of the ends at the finest octave.
    MESSAGE("largest difference " << worst << " of the sum of the octaves' slopes (bound 2e-6)");
    CHECK(worst < 2e-6);
}

TEST_CASE("|f(p) - f(q)| <= L |p - q|, for random pairs and for pairs along the steepest slopes found") {
    Random random(14);
    double worst = 0.0;
    for (int trial = 0; trial < 240; ++trial) {
        scene::Surface surface = random_surface(random);
        surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
        if (trial % 3 == 0) surface.octaves = 1;
        const trace::Field field(surface);
        const double cell = 1.0 / field.octaves().back().frequency;
        const auto check_pair = [&](const glm::dvec3& p, const glm::dvec3& q) {
            const double rise = std::abs(field.value(p) - field.value(q));
            const double slack = 2.0 * rounding(field, p) + 2.0 * rounding(field, q);
            REQUIRE(rise <= field.lipschitz() * glm::distance(p, q) + slack);
            if (rise > 1e6 * slack) worst = std::max(worst, rise / (field.lipschitz() * glm::distance(p, q)));
        };
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 p = anywhere(random, 8.0);
            check_pair(p, p + log_uniform(random, 1e-6, 10.0) * unit_vector(random));
        }
        const glm::dvec3 steep = climb(random, anywhere(random, 8.0), 0.3 * cell,
                                       [&](const glm::dvec3& x) { return glm::length(field.gradient(x)); });
        const glm::dvec3 uphill = glm::normalize(field.gradient(steep));
        for (const double h : {1e-3, 1e-2, 0.1}) check_pair(steep - h * cell * uphill, steep + h * cell * uphill);
    }
    MESSAGE("steepest pair " << worst << " of the bound");
    CHECK(worst > 0.5);
}

TEST_CASE("the sum of octaves never exceeds amplitude(), at random points and at the highest found") {
    Random random(15);
    double worst = 0.0;
    for (int trial = 0; trial < 240; ++trial) {
        scene::Surface surface = random_surface(random);
        surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
        if (trial % 3 == 0) surface.octaves = 1;
        const trace::Field field(surface);
        const auto size = [&](const glm::dvec3& x) { return std::abs(field.base(x) - field.value(x)); };
        double highest = 0.0;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 start = anywhere(random, 8.0);
            highest = std::max(highest, size(climb(random, start, 0.4 / surface.frequency, size)));
        }
        REQUIRE(highest <= field.amplitude());
        worst = std::max(worst, highest / field.amplitude());
    }
    MESSAGE("highest sum " << worst << " of the bound");
    CHECK(worst > 0.7);
}

TEST_CASE("drifting noise is the oracle's at the time, while base and bound stay") {
    Random random(77);
    double worst = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
        scene::Surface surface = random_drifting_surface(random);
        surface.kind = support::any_kind(static_cast<std::uint64_t>(trial));
        const trace::Field field(surface);
        const double time = uniform(random, -50.0, 50.0);
        const oracle::FieldOracle expected(shape_of(surface, time));
        const glm::dvec3 x = 20.0 * unit_vector(random), shift = field.noise_shift(time);
        // Positions reach 20 + 50 * 100; they are rounded a few times on the way, and so are the sums.
        const double size = glm::length(x) + glm::length(shift);
        const double rounding = 16 * 0x1p-53 * (size * field.lipschitz() + std::abs(field.base(x)) + field.amplitude());
        const double error =
            std::abs(field.value(x, shift) - static_cast<double>(expected.value<long double>({x.x, x.y, x.z})));
        worst = std::max(worst, error / rounding);
        CHECK(field.noise_shift(0.0) == glm::dvec3(0.0));
    }
    MESSAGE("largest error " << worst << " of the bound");
    CHECK(worst < 1.0);
    scene::Surface still = random_surface(random);
    CHECK(!trace::Field(still).drifts());
    CHECK(trace::Field(still).noise_shift(1e300) == glm::dvec3(0.0));
}
