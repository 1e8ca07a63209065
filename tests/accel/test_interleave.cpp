// Morton codes by the vector, against one bit at a time.
#include "src/accel/interleave_simd.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/trace/fast_tracer_cases.h"

using namespace strata;
using namespace strata::trace_test;

namespace {

std::uint64_t column(double x, double scale, double bias) {
    const double found = std::floor(x * scale) + bias;
    return static_cast<std::uint64_t>(std::clamp(found, 0.0, 2.0 * bias - 1.0));
}

std::uint64_t interleaved(std::uint64_t x, std::uint64_t y) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < 32; ++bit) {
        code |= (x >> bit & 1) << (2 * bit);
        code |= (y >> bit & 1) << (2 * bit + 1);
    }
    return code;
}

double any_position(Random& random, double bias, double scale) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double exact = std::floor(uniform(random, -bias, bias)) / scale;
    const std::vector<double> choices{exact,
                                      std::nextafter(exact, -kInfinity),
                                      uniform(random, -1.0, 1.0),
                                      uniform(random, -bias, bias) / scale,
                                      -1e-300,
                                      1e300,
                                      -kInfinity,
                                      kInfinity,
                                      bias / scale};
    return choices[random() % choices.size()];
}

}  // namespace

TEST_CASE(
    "columns and rows are interleaved bit by bit, clamped at the edges, for any number of points, on every target") {
    on_every_target([](const std::string& target) {
        Random random(91);
        int different = 0;
        for (int trial = 0; trial < 400; ++trial) {
            const double scale = std::exp2(static_cast<double>(random() % 20) - 7.0);
            const double bias = std::exp2(static_cast<double>(1 + random() % 31));
            std::vector<double> u(random() % 40), v(u.size());
            for (double& x : u) x = any_position(random, bias, scale);
            for (double& x : v) x = any_position(random, bias, scale);
            std::vector<std::uint64_t> codes(u.size());
            accel::interleave_columns(u, v, scale, bias, codes);
            for (std::size_t i = 0; i < u.size(); ++i) {
                different += codes[i] != interleaved(column(u[i], scale, bias), column(v[i], scale, bias));
            }
        }
        CAPTURE(target);
        CHECK(different == 0);
    });
}

TEST_CASE("the column and the row of a code are what it was interleaved from") {
    Random random(92);
    for (int trial = 0; trial < 1000; ++trial) {
        const std::uint64_t column = random() >> (32 + random() % 32), row = random() >> (32 + random() % 32);
        const accel::Square found = accel::square_of(interleaved(column, row));
        REQUIRE(found.column == column);
        REQUIRE(found.row == row);
    }
}
