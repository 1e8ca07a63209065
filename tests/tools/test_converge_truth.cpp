#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

#include "shaders_cpu/checker.h"
#include "shaders_cpu/edge.h"
#include "shaders_cpu/zoneplate.h"
#include "tools/converge/quadrature.h"
#include "tools/converge/truth.h"

using namespace strata;

namespace {

// The centred B-spline as an m-fold moving average: sampled densities convolved by running sums, sharing nothing with
// src/filter. Densities at the midpoints of `steps` parts a pixel.
std::vector<double> sampled_spline(int m, int steps) {
    std::vector<double> density{static_cast<double>(steps)};  // a unit of mass in one cell
    for (int order = 0; order < m; ++order) {
        std::vector<double> next(density.size() + static_cast<std::size_t>(steps) - 1, 0.0);
        for (std::size_t i = 0; i < density.size(); ++i)
            for (std::size_t k = 0; k < static_cast<std::size_t>(steps); ++k) next[i + k] += density[i] / steps;
        density = next;
    }
    for (double& value : density) value /= steps;
    return density;  // masses; they sum to 1
}

// Pixel (x,y) of function(u, v) by brute force: a grid over the support.
double brute_force(const std::function<double(double, double)>& function, int m, int x, int y, int steps) {
    const std::vector<double> mass = sampled_spline(m, steps);
    const double first = -0.5 * static_cast<double>(mass.size() - 1) / steps;
    double sum = 0;
    for (std::size_t j = 0; j < mass.size(); ++j) {
        double row = 0;
        const double v = y + 0.5 + first + static_cast<double>(j) / steps;
        for (std::size_t i = 0; i < mass.size(); ++i)
            row += mass[i] * function(x + 0.5 + first + static_cast<double>(i) / steps, v);
        sum += mass[j] * row;
    }
    return sum;
}

}  // namespace

TEST_CASE("Gauss-Legendre is exact for polynomials of degree 2n - 1, and its weights sum to 2") {
    for (const int n : {1, 2, 3, 5, 12, 40, 62, 100}) {
        const tools::converge::GaussLegendre rule(n);
        double sum = 0;
        for (const double weight : rule.weights) sum += weight;
        CAPTURE(n);
        CHECK(sum == doctest::Approx(2.0).epsilon(1e-13));
        const int degree = 2 * n - 1;
        const double integral = rule.integrate(0, 1, [&](double x) { return std::pow(x, degree); });
        CHECK(integral == doctest::Approx(1.0 / (degree + 1)).epsilon(1e-12));
    }
}

TEST_CASE(
    "an edge's coverage: a half in the middle, its mirror image, all or nothing beyond the filter, a closed form") {
    for (const int m : {1, 2, 3, 4, 7, 20, 100}) {
        for (const double angle : {0.0, 30.0, 45.0, 90.0, 135.0, 211.7, 359.999999}) {
            CAPTURE(m);
            CAPTURE(angle);
            CHECK(tools::converge::edge_coverage(m, angle, 0) == doctest::Approx(0.5).epsilon(1e-12));
            CHECK(tools::converge::edge_coverage(m, angle, 0.3) + tools::converge::edge_coverage(m, angle, -0.3) ==
                  doctest::Approx(1.0).epsilon(1e-12));
            CHECK(tools::converge::edge_coverage(m, angle, m) == 1.0);
            CHECK(tools::converge::edge_coverage(m, angle, -m) == 0.0);
        }
    }
    CHECK(tools::converge::edge_coverage(1, 0, 0.25) == doctest::Approx(0.75));
    // A box cut at 45 degrees, d from its middle: 1 - (1 - d sqrt 2)^2 / 2 beyond d > 0.
    const double d = 0.4;
    CHECK(tools::converge::edge_coverage(1, 45, d) == doctest::Approx(1 - 0.5 * std::pow(1 - d * std::sqrt(2.0), 2)));
}

TEST_CASE("an edge is what brute force makes of it") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit;
    scene::Scene scene;
    scene.image = scene::ImageKind::edge;
    scene.film = {16, 9, 0};
    for (const int m : {1, 2, 4, 5}) {
        scene.edge = {360 * unit(random), 4 * unit(random) - 2};
        const auto truth = tools::converge::exact_picture(scene, m, {6, 2, 9, 5});
        REQUIRE(truth);
        for (int i = 0; i < 9; ++i) {
            const auto function = [&](double u, double v) {
                return static_cast<double>(shaders::edge(scene.edge, 16, 9, u, v, 0));
            };
            const double brute = brute_force(function, m, 6 + i % 3, 2 + i / 3, 160);
            CAPTURE(m);
            CHECK(std::fabs(truth->grey[static_cast<std::size_t>(i)] - brute) < 1.5e-3);
        }
    }
}

TEST_CASE("a zone plate is what brute force makes of it, and far finer rings too") {
    scene::Scene scene;
    scene.image = scene::ImageKind::zoneplate;
    scene.film = {24, 16, 0};
    for (const double rings : {0.0, 7.3, 40.0}) {
        scene.zoneplate.rings = rings;
        for (const int m : {1, 3, 4}) {
            const auto truth = tools::converge::exact_picture(scene, m, {18, 10, 20, 12});
            REQUIRE(truth);
            CHECK(truth->error < 1e-9);
            const auto function = [&](double u, double v) {
                return static_cast<double>(shaders::zoneplate(scene.zoneplate, 24, 16, u, v, 0));
            };
            for (int i = 0; i < 4; ++i) {
                // Sampled masses widen the filter by 1/steps, an error of its square.
                const double brute = brute_force(function, m, 18 + i % 2, 10 + i / 2, m == 1 ? 300 : 120);
                CAPTURE(rings);
                CAPTURE(m);
                CHECK(std::fabs(truth->grey[static_cast<std::size_t>(i)] - brute) < (rings > 10 ? 4e-3 : 3e-4));
            }
        }
    }
    scene.zoneplate.rings = 1e8;
    CHECK(!tools::converge::exact_picture(scene, 4, {0, 0, 2, 2}));
}

TEST_CASE("a checkered plane is what brute force makes of it, above, at and below the horizon") {
    scene::Scene scene;
    scene.image = scene::ImageKind::checker;
    scene.film = {24, 16, 0};
    for (const int m : {1, 2, 4, 5}) {
        for (const double horizon : {0.3, 0.25}) {
            scene.checker = {1.3, 0.9, horizon};
            const film::Rect window{10, 2, 14, 16};
            const auto truth = tools::converge::exact_picture(scene, m, window);
            REQUIRE(truth);
            const auto function = [&](double u, double v) {
                return static_cast<double>(shaders::checker(scene.checker, 24, 16, u, v, 0));
            };
            double worst = 0;
            for (int i = 1; i < 56; i += 7) {
                // Next to the horizon squares are finer than any grid.
                const int steps = m == 1 ? 768 : m == 2 ? 320 : 192;
                const double brute = brute_force(function, m, 10 + i % 4, 2 + i / 4, steps);
                worst = std::max(worst, std::fabs(truth->grey[static_cast<std::size_t>(i)] - brute));
            }
            CAPTURE(m);
            CAPTURE(horizon);
            MESSAGE("m ", m, ", horizon ", horizon, ": differs from brute force by ", worst);
            CHECK(worst < 3e-3);
        }
    }
}

TEST_CASE("a checkered plane's parts agree whichever window they are asked for in, and the sky is even") {
    scene::Scene scene;
    scene.image = scene::ImageKind::checker;
    scene.film = {32, 32, 0};
    for (const int m : {1, 4}) {
        const auto whole = tools::converge::exact_picture(scene, m, {0, 0, 32, 32});
        const auto part = tools::converge::exact_picture(scene, m, {5, 8, 9, 20});
        REQUIRE(whole);
        REQUIRE(part);
        CHECK(whole->grey[3] == 0.5);
        for (std::size_t y = 0; y < 12; ++y)
            for (std::size_t x = 0; x < 4; ++x)
                CHECK(std::fabs(whole->grey[(y + 8) * 32 + x + 5] - part->grey[y * 4 + x]) <=
                      whole->error + part->error);
    }
}

TEST_CASE("a ramp and a constant are themselves, and nothing is claimed of other images") {
    scene::Scene scene;
    scene.film = {8, 6, 0};
    scene.image = scene::ImageKind::constant;
    scene.constant.value = 0.3;
    CHECK(tools::converge::exact_picture(scene, 4, {0, 0, 8, 6})->grey ==
          std::vector<double>(48, static_cast<double>(0.3f)));
    scene.image = scene::ImageKind::ramp;
    scene.ramp = {0, 2};
    CHECK(tools::converge::exact_picture(scene, 3, {0, 0, 8, 6})->grey[0] == doctest::Approx(0.5 - 2 * 3.5 / 8));
    for (const auto kind : {scene::ImageKind::surface, scene::ImageKind::wheel}) {
        scene.image = kind;
        CHECK(!tools::converge::has_exact_picture(scene));
        CHECK(!tools::converge::exact_picture(scene, 4, {0, 0, 1, 1}));
    }
}
