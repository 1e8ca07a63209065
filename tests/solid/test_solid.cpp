// What src/solid/solid.h asks of every kind of solid, on random shapes of all of them.
#include "src/solid/solid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>

#include "tests/support/random.h"
#include "tests/support/surfaces.h"

using namespace strata;
using solid::Solid;

namespace {

using support::log_uniform;
using support::Random;
using support::uniform;
using support::unit_vector;

// Sets every key of a solid anywhere in its range, lengths no larger than 1000, and notes the names.
struct RandomKeys {
    Random& random;
    std::vector<std::string> names{};

    void number(std::string name, double& field, double min, double max, std::string_view, std::string_view) {
        field = min > 0.0 ? log_uniform(random, std::max(min, 1e-2), std::min(max, 1e3))
                          : uniform(random, std::max(min, -1e3), std::min(max, 1e3));
        names.push_back(std::move(name));
    }
    void vector(std::string name, glm::dvec3& field, double min, double max, std::string_view unit,
                std::string_view meaning) {
        for (int a = 0; a < 3; ++a) number(name, field[a], min, max, unit, meaning);
        names.resize(names.size() - 2);
    }
    template <class E>
    void choice(std::string name, E& field, std::span<const std::string_view> all, std::string_view) {
        field = static_cast<E>(random() % all.size());
        names.push_back(std::move(name));
    }
    void count(std::string name, int& field, int min, int max, std::string_view) {
        field = std::uniform_int_distribution<int>(min, std::min(max, 1000))(random);
        names.push_back(std::move(name));
    }
};

// One of each kind with random keys.
std::vector<Solid> random_solids(Random& random) {
    std::vector<Solid> all;
    for (const solid::Kind kind : support::all_kinds()) {
        solid::Solids solids;
        std::apply(
            [&](auto&... each) {
                RandomKeys keys{random};
                (each.keys(keys), ...);
            },
            solids);
        all.push_back(solid::pick(solids, kind));
    }
    return all;
}

const solid::KindRow& row_of(const Solid& of) { return solid::all_solids()[of.index()]; }

double value(const Solid& of, const glm::dvec3& x) {
    return solid::visit([&](const auto& s) { return s.value(x); }, of);
}

glm::dvec3 gradient(const Solid& of, const glm::dvec3& x) {
    return solid::visit([&](const auto& s) { return s.gradient(x); }, of);
}

// Of a value at a point of this size: a few operations on lengths up to it.
double rounding(const Solid& of, double size) { return 16 * 0x1p-53 * (size + std::abs(value(of, glm::dvec3(0.0)))); }

}  // namespace

TEST_CASE("each kind has a name and keys of its own, and is found by its place in the list") {
    Random random(1);
    std::set<std::string_view> names;
    std::set<std::string> keys;
    std::size_t place = 0;
    solid::Solids solids;
    const auto look_at = [&](auto& shape) {
        using S = std::remove_cvref_t<decltype(shape)>;
        RandomKeys own{random};
        shape.keys(own);
        for (const std::string& key : own.names) CHECK_MESSAGE(keys.insert(key).second, key);
        CHECK(names.insert(S::kName).second);
        CHECK_FALSE(S::kMeaning.empty());
        CHECK(solid::kKind<S> == static_cast<solid::Kind>(place));
        CHECK(solid::row_of(solid::kKind<S>).name == S::kName);
        CHECK(solid::pick(solids, solid::kKind<S>).index() == place++);
    };
    std::apply([&](auto&... each) { (look_at(each), ...); }, solids);
    CHECK(place == solid::kKinds);
}

TEST_CASE("the base is convex along every line, as the tracers' lower bounds take it to be") {
    Random random(2);
    for (int trial = 0; trial < 4000; ++trial) {
        for (const Solid& s : random_solids(random)) {
            const glm::dvec3 x = log_uniform(random, 1e-2, 1e4) * unit_vector(random);
            const glm::dvec3 step = log_uniform(random, 1e-3, 1e4) * unit_vector(random);
            const double middle = value(s, x), sum = value(s, x + step) + value(s, x - step);
            CAPTURE(row_of(s).name);
            REQUIRE(sum >= 2.0 * middle - 4.0 * rounding(s, glm::length(x) + glm::length(step)));
        }
    }
}

// For a convex function the tangents at both ends of a step enclose its rise.
TEST_CASE("the gradient is the value's, and no longer than kSteepest") {
    Random random(3);
    for (int trial = 0; trial < 4000; ++trial) {
        for (const Solid& s : random_solids(random)) {
            const glm::dvec3 x = log_uniform(random, 1e-2, 1e4) * unit_vector(random);
            const glm::dvec3 step = 1e-3 * glm::length(x) * unit_vector(random);
            const double rise = value(s, x + step) - value(s, x), slack = 4.0 * rounding(s, glm::length(x));
            CAPTURE(row_of(s).name);
            REQUIRE(rise >= glm::dot(gradient(s, x), step) - slack);
            REQUIRE(rise <= glm::dot(gradient(s, x + step), step) + slack);
            const double steepest = solid::visit([](const auto& shape) { return shape.kSteepest; }, s);
            REQUIRE(glm::length(gradient(s, x)) <= steepest * (1.0 + 1e-15));
            REQUIRE(glm::length(gradient(s, glm::dvec3(0.0))) <= steepest * (1.0 + 1e-15));
        }
    }
}

// A second difference is a mean of the second derivative over the step.
TEST_CASE("where it may be solid, the base bends by no more than its half_curvature says") {
    Random random(7);
    int bounded = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        for (const Solid& s : random_solids(random)) {
            const double amplitude = log_uniform(random, 1e-3, 1.0);
            const glm::dvec3 x = solid::over(s, log_uniform(random, 1e-1, 1e3) * unit_vector(random), amplitude);
            const glm::dvec3 step = uniform(random, 0.0, 2.0 * amplitude) * unit_vector(random);
            const double half = solid::visit([&](const auto& shape) { return shape.half_curvature(amplitude); }, s);
            const double bend = value(s, x + step) + value(s, x - step) - 2.0 * value(s, x);
            CAPTURE(row_of(s).name);
            REQUIRE(bend <= 2.0 * half * glm::dot(step, step) + 8.0 * rounding(s, glm::length(x)));
            bounded += half < 1e300;
        }
    }
    CHECK(bounded > 4000);
}

TEST_CASE("up is of unit length, +y over what is level, and height rises along it") {
    Random random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        for (const Solid& s : random_solids(random)) {
            const glm::dvec3 x = log_uniform(random, 1e-1, 1e4) * unit_vector(random);
            const glm::dvec3 up = solid::visit([&](const auto& shape) { return shape.up(x); }, s);
            const auto height = [&](const glm::dvec3& p) {
                return solid::visit([&](const auto& shape) { return shape.height(p); }, s);
            };
            CAPTURE(row_of(s).name);
            REQUIRE(std::abs(glm::length(up) - 1.0) < 1e-14);
            if (row_of(s).is_level) REQUIRE(up == glm::dvec3(0.0, 1.0, 0.0));
            const double length = glm::length(x);
            REQUIRE(std::abs(height(x + length * up) - height(x) - length) <= 4.0 * rounding(s, 2.0 * length));
        }
    }
}

// Where there is a bound, a point is in it if a ray from there begins in it.
TEST_CASE("what can be solid lies in clip()'s part of a ray and in the extent") {
    Random random(5);
    std::vector<int> inside(solid::kKinds);
    for (int trial = 0; trial < 4000; ++trial) {
        for (const Solid& s : random_solids(random)) {
            const double amplitude = random() % 4 == 0 ? 0.0 : log_uniform(random, 1e-3, 1e2);
            const glm::dvec3 origin = log_uniform(random, 1e-2, 1e4) * unit_vector(random);
            const glm::dvec3 direction = unit_vector(random);
            const double limit = log_uniform(random, 1e-2, 1e4), at = uniform(random, 0.0, limit);
            const glm::dvec3 x = origin + at * direction;
            const auto clip = [&](const glm::dvec3& from, double length) {
                return solid::visit([&](const auto& shape) { return shape.clip(from, direction, length, amplitude); },
                                    s);
            };
            const bool may_be =
                row_of(s).has_bound ? clip(x, 1e-9).begin == 0.0 && clip(x, 1e-9).end > 0.0 : value(s, x) <= amplitude;
            if (!may_be) continue;
            ++inside[s.index()];
            CAPTURE(row_of(s).name);
            const solid::Interval kept = clip(origin, limit);
            const double slack = 1e-12 * (glm::length(origin) + limit);
            REQUIRE(kept.begin <= at + slack);
            REQUIRE(kept.end >= at - slack);
            const solid::Extent extent = solid::visit([&](const auto& shape) { return shape.extent(amplitude); }, s);
            REQUIRE(glm::length(x) <= extent.ball + slack);
            REQUIRE(glm::dot(extent.up, x) <= amplitude + slack);
        }
    }
    for (const int count : inside) CHECK(count > 200);
}

TEST_CASE("over() leads to the height that is asked for") {
    Random random(6);
    for (int trial = 0; trial < 1000; ++trial) {
        for (const Solid& s : random_solids(random)) {
            const glm::dvec3 x = log_uniform(random, 1e-1, 1e3) * unit_vector(random);
            const double height = uniform(random, 0.0, 10.0);
            CAPTURE(row_of(s).name);
            if (gradient(s, x) == glm::dvec3(0.0)) {
                REQUIRE(solid::over(s, x, height) == x);
            } else {
                REQUIRE(std::abs(value(s, solid::over(s, x, height)) - height) <= 8.0 * rounding(s, 2e3));
            }
        }
    }
}
