#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "shaders_cpu/checker.h"

using namespace strata;
using shaders::checker;

namespace {

// Where a point of the plane, x to the right and z ahead (world units), appears: similar triangles.
struct Pixel {
    double u, v;
};
Pixel project(const scene::Checker& parameters, int width, int height, double x, double z) {
    const double focal = width;
    return {0.5 * width + focal * x / z, parameters.horizon * height + focal * parameters.height / z};
}

}  // namespace

TEST_CASE("points of the plane projected to the screen find the square they lie in") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit;
    int tried = 0;
    for (const scene::Checker& parameters : {scene::Checker{1.0, 1.0, 0.3}, {0.37, 2.5, 0.0}, {12.0, 0.8, 0.61}})
        for (int i = 0; i < 50000; ++i) {
            const double column = std::floor(200.0 * unit(random)) - 100.0;
            const double row = std::floor(100.0 * unit(random));
            // Away from the square's border by more than rounding.
            const double x = (column + 0.001 + 0.998 * unit(random)) * parameters.square;
            const double z = (row + 0.001 + 0.998 * unit(random)) * parameters.square;
            const Pixel pixel = project(parameters, 960, 540, x, z);
            const bool white = (static_cast<long>(column) + static_cast<long>(row)) % 2 == 0;
            REQUIRE(checker(parameters, 960, 540, pixel.u, pixel.v, 0.0) == (white ? 1.0f : 0.0f));
            ++tried;
        }
    CHECK(tried == 150000);
}

TEST_CASE("straight lines of the plane meet in one point of the horizon") {
    // A border between columns x = k * square is crossed on the screen along the line from the vanishing point.
    const scene::Checker parameters;
    for (const int k : {-3, -1, 1, 2, 5})
        for (const double z : {3.3, 7.7, 20.4}) {
            const Pixel border = project(parameters, 960, 540, k, z);
            const float left = checker(parameters, 960, 540, border.u - 1e-6, border.v, 0.0);
            const float right = checker(parameters, 960, 540, border.u + 1e-6, border.v, 0.0);
            CHECK(left + right == 1.0f);
            CHECK((border.u - 480.0) / (border.v - 0.3 * 540) == doctest::Approx(k / parameters.height));
        }
}

TEST_CASE("above the horizon the sky is the mean of the squares") {
    for (const double horizon : {0.0, 0.3, 1.0})
        for (const double u : {-5.0, 0.0, 100.0, 960.0})
            for (const double above : {0.0, 1e-9, 1.0, 200.0})
                CHECK(checker({1.0, 1.0, horizon}, 960, 540, u, horizon * 540 - above, 0.0) == 0.5f);
    // Squares from rows well below the horizon average to it, too.
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit;
    double sum = 0.0;
    for (int i = 0; i < 200000; ++i) sum += checker({}, 960, 540, 960 * unit(random), 170 + 60 * unit(random), 0.0);
    // Standard error 0.0011; the squares at the picture's edge are cut.
    CHECK(sum / 200000 == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("the checker is the same picture at any size, and still") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit;
    int different = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = unit(random);
        const double y = 0.35 + 0.65 * unit(random);
        different += checker({}, 160, 90, 160 * x, 90 * y, 0.0) != checker({}, 1920, 1080, 1920 * x, 1080 * y, 5.0);
    }
    CHECK(different == 0);
}

TEST_CASE("the checker is 0, 1/2 or 1 for extreme parameters and places") {
    for (const double square : {1e-300, 1e-9, 1.0, 1e9, 1e300})
        for (const double eye : {1e-300, 1e-9, 1.0, 1e9, 1e300})
            for (const double v : {-1e9, 162.0, std::nextafter(162.0, 1e9), 163.0, 540.0, 1e9})
                for (const double u : {-1e9, 480.0, 1e9}) {
                    const float value = checker({square, eye, 0.3}, 960, 540, u, v, 0.0);
                    CHECK((value == 0.0f || value == 0.5f || value == 1.0f));
                }
}
