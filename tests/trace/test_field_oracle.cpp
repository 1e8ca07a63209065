// The oracle of field_oracle.h itself: its certainty, its rays against a dense scan, its clipping.
#include "tools/stability/oracles/field_oracle.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "noise/bounds.h"
#include "tests/support/random.h"
#include "tools/stability/oracles/ray_oracle.h"

namespace {

using namespace strata::oracle;
using strata::support::uniform;

Vec random_direction(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    Vec d{normal(random), normal(random), normal(random)};
    const double length = std::hypot(d[0], d[1], d[2]);
    for (double& x : d) x /= length;
    return d;
}

Vec along(const Vec& p, const Vec& d, double s) { return {p[0] + s * d[0], p[1] + s * d[1], p[2] + s * d[2]}; }

Shape random_shape(std::mt19937_64& random) {
    Shape shape;
    shape.kind = static_cast<Kind>(random() % kShapeKinds);
    shape.octaves = 1 + static_cast<int>(random() % 10);
    shape.lacunarity = uniform(random, 1.7, 3.0);
    shape.gain = uniform(random, 0.3, 0.7);
    shape.amplitude = uniform(random, 0.1, 2.0);
    shape.frequency = uniform(random, 0.2, 2.0);
    shape.seed = random();
    shape.radius = 3.0;
    shape.threshold = uniform(random, -0.2, 0.2);
    if (shape.kind == Kind::isosurface) {
        shape.container = random() % 2 == 0 ? Container::ball : Container::box;
        shape.container_size = {3.0, 2.0, 2.5};
    }
    return shape;
}

// A point near the surface or anywhere about it.
Vec random_point(std::mt19937_64& random, const FieldOracle& field) {
    Vec p{uniform(random, -4.0, 4.0), uniform(random, -4.0, 4.0), uniform(random, -4.0, 4.0)};
    const bool heightfield = field.shape().kind == Kind::terrain || field.shape().kind == Kind::hyperterrain;
    if (heightfield && random() % 2 == 0) p[1] -= field.value(p) * uniform(random, 0.9, 1.1);
    return p;
}

}  // namespace

TEST_CASE("the oracle's bounds of the noise are no smaller than the certified ones") {
    CHECK(kMaxValue2 >= strata::noise::kBounds2.value);
    CHECK(kMaxSlope2 >= strata::noise::kBounds2.gradient);
    CHECK(kMaxValue3 >= strata::noise::kBounds3.value);
    CHECK(kMaxSlope3 >= strata::noise::kBounds3.gradient);
}

TEST_CASE("f keeps its sign within the distance that a probe clears") {
    std::mt19937_64 random(3);
    double largest_share = 0.0;
    for (int trial = 0; trial < 6000; ++trial) {
        const FieldOracle field(random_shape(random));
        const Vec p = random_point(random, field), d = random_direction(random);
        const Probe line = field.probe(p, d);
        const double f = field.value(p);
        REQUIRE(std::signbit(line.f) == std::signbit(f));
        if (!std::isfinite(line.clear)) continue;
        for (int i = 0; i < 10; ++i) {
            const double s = line.clear * uniform(random, -1.0, 1.0);
            REQUIRE(std::signbit(field.value(along(p, d, s))) == std::signbit(f));
        }
        // How far the sign in fact stays, at most twice the distance cleared.
        double reach = 2.0;
        for (double share = 1.0; share < 2.0; share += 0.01) {
            if (std::signbit(field.value(along(p, d, share * line.clear))) != std::signbit(f)) {
                reach = share;
                break;
            }
        }
        largest_share = std::max(largest_share, 1.0 / reach);
    }
    MESSAGE("largest cleared distance, of the distance to the root: " << largest_share);
    CHECK(largest_share > 0.9);
}

TEST_CASE("noise vanishes on the lattice of its octave, in every block of 2^32 cells") {
    std::mt19937_64 random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        Shape shape{.kind = random() % 2 == 0 ? Kind::terrain : Kind::hyperterrain, .octaves = 1, .frequency = 1.0};
        shape.seed = random();
        const FieldOracle field(shape);
        Vec p;
        const double scale = std::exp2(uniform(random, 0.0, 40.0));
        const Vec& offset = field.octaves()[0].offset;
        const Vec shift = shape.kind == Kind::terrain ? Vec{offset[0], 0.0, offset[1]} : offset;
        for (std::size_t a = 0; a < 3; ++a) p[a] = std::floor(uniform(random, -scale, scale)) - shift[a];
        CHECK(std::abs(field.octave(0, p)) < 8.0 * std::max(1.0, scale) * 0x1p-52);
    }
}

TEST_CASE("double agrees with extended precision") {
    std::mt19937_64 random(5);
    double worst = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
        const FieldOracle field(random_shape(random));
        const Vec p = random_point(random, field);
        double scale = 10.0;
        for (const OracleOctave& octave : field.octaves()) scale += 60.0 * octave.amplitude * octave.frequency;
        worst = std::max(worst, std::abs(static_cast<double>(field.value<long double>(p) - field.value(p))) / scale);
    }
    MESSAGE("largest difference " << worst / 0x1p-53 << " ulp of the largest position times slope");
    CHECK(worst < 0x1p-53);
}

TEST_CASE("rays against noise surfaces: the first thick stretch of a dense scan is allowed, later hits are not") {
    std::mt19937_64 random(6);
    const auto delta = [](double t) { return 1e-3 + 1e-3 * t; };
    int hits = 0, misses = 0;
    long probes = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const FieldOracle field(random_shape(random));
        const Vec p = along(random_point(random, field), {0.0, 1.0, 0.0}, 0.3), d = random_direction(random);
        constexpr double kLimit = 8.0;
        const Span span = clip(field.shape(), p, d, kLimit);
        // A scan at a fortieth of the tolerance: begin of the first stretch thicker than 1.1 delta.
        double begin = NAN, first = NAN;
        bool borderline = false;
        for (double t = span.begin; t <= span.end && std::isnan(first); t += delta(t) / 40.0) {
            if (field.value(along(p, d, t)) < 0.0) {
                if (std::isnan(begin)) begin = t;
                if (t - begin > 1.1 * delta(t)) first = begin;
            } else if (!std::isnan(begin)) {
                borderline = borderline || t - begin > 0.9 * delta(t);
                begin = NAN;
            }
        }
        borderline = borderline || (std::isnan(first) && !std::isnan(begin));
        if (borderline) continue;
        const Verdict miss = judge_ray(field, p, d, kLimit, delta, {false, 0.0});
        probes += miss.probes;
        CAPTURE(trial);
        CHECK(miss.missed == !std::isnan(first));
        if (std::isnan(first)) {
            ++misses;
            continue;
        }
        ++hits;
        // Scan and judge may differ in which of two stretches a hair apart they take for one: what they found overlaps,
        // and the judge's begins at a root.
        const Span found = miss.stretch;
        CHECK(found.begin <= first + 1.1 * delta(first));
        CHECK(found.end >= first);
        CHECK(found.end - found.begin > delta(found.begin));
        const double hair = delta(first) / 1000.0;
        if (found.begin > span.begin) CHECK(field.value(along(p, d, found.begin - hair)) >= 0.0);
        CHECK(field.value(along(p, d, found.begin + hair)) < 0.0);
        CHECK(judge_ray(field, p, d, kLimit, delta, {true, first}).ok());
        CHECK(judge_ray(field, p, d, kLimit, delta, {true, first + 1.1 * delta(first)}).missed);
    }
    MESSAGE(hits << " hits, " << misses << " misses, " << probes / (hits + misses) << " probes a ray");
    CHECK(hits > 100);
    CHECK(misses > 50);
}

TEST_CASE("clipping keeps exactly the points within the container") {
    std::mt19937_64 random(7);
    int inside_points = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Shape shape{.kind = Kind::isosurface, .container_size = {1.0, 0.5, 2.0}};
        shape.container = trial % 2 == 0 ? Container::ball : Container::box;
        const Vec p{uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0), uniform(random, -3.0, 3.0)};
        Vec d = random_direction(random);
        if (trial % 5 == 0) d = {0.0, 0.0, 1.0};
        const Span span = clip(shape, p, d, 10.0);
        const double t = uniform(random, 0.0, 10.0);
        const Vec q = along(p, d, t);
        bool inside = std::hypot(q[0], q[1], q[2]) <= 1.0;
        if (shape.container == Container::box)
            inside = std::abs(q[0]) <= 1.0 && std::abs(q[1]) <= 0.5 && std::abs(q[2]) <= 2.0;
        CHECK(inside == (t >= span.begin && t <= span.end));
        inside_points += inside;
    }
    CHECK(inside_points > 100);
}
