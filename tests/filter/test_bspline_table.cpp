#include "src/filter/bspline_table.h"

#include <doctest/doctest.h>
#include <hwy/targets.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "src/filter/bspline.h"
#include "tests/filter/quadrature.h"

using namespace strata::filter;

namespace {

// Runs body on every SIMD target of this build that the machine has.
template <class Body>
void for_each_target(Body body) {
    for (int64_t target : {HWY_SCALAR, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
        if ((hwy::SupportedTargets() & target) == 0 && target != HWY_SCALAR) continue;
        hwy::SetSupportedTargetsForTest(target);
        CAPTURE(hwy::TargetName(target));
        body(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(0);
    }
}

// Every cell: its ends, their neighbours and random points; below the table, down to zero. Both signs.
std::vector<float> signed_probabilities(int per_cell) {
    std::mt19937 random(1);
    std::vector<float> tails{0.0f, std::numeric_limits<float>::denorm_min(), 1e-40f, 1e-30f, 1e-20f, 0.5f};
    for (int octave = -40; octave < -1; ++octave) {
        for (int eighth = 0; eighth < 8; ++eighth) {
            const float low = std::ldexp(1 + static_cast<float>(eighth) / 8, octave);
            const float high = std::ldexp(1 + static_cast<float>(eighth + 1) / 8, octave);
            std::uniform_real_distribution<float> inside(low, high);
            tails.push_back(low);
            tails.push_back(std::nextafter(high, 0.0f));
            for (int i = 0; i < per_cell; ++i) tails.push_back(inside(random));
        }
    }
    std::vector<float> q;
    for (float tail : tails) {
        q.push_back(tail);
        q.push_back(-tail);
    }
    return q;
}

double exact_centred(int m, float q) {
    const double distance = 0.5 * m - bspline_inverse_tail(m, std::abs(static_cast<double>(q)));
    return std::signbit(q) ? -distance : distance;
}

bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::vector<float> bulk(const BsplineTable& table, const std::vector<float>& q) {
    std::vector<float> x(q.size(), std::numeric_limits<float>::quiet_NaN());
    table.centred(q, x);
    return x;
}

}  // namespace

TEST_CASE("the table keeps its error bound at every order, everywhere, on every SIMD target") {
    const std::vector<float> q = signed_probabilities(40);
    std::vector<double> exact(q.size());
    double worst = 0;
    for (int m = kMinOrder; m <= kMaxTableOrder; ++m) {
        const BsplineTable table(m);
        std::transform(q.begin(), q.end(), exact.begin(), [m](float value) { return exact_centred(m, value); });
        for_each_target([&](const char*) {
            const std::vector<float> x = bulk(table, q);
            for (std::size_t i = 0; i < q.size(); ++i) {
                const double error = std::abs(x[i] - exact[i]);
                if (!(error <= kTableError)) FAIL("m = " << m << ", q = " << q[i] << ": error " << error);
                worst = std::max(worst, error);
            }
        });
    }
    MESSAGE("max observed / bound: " << worst / kTableError);
}

TEST_CASE("above the table's orders, and below its floor, the answer is the exact one rounded") {
    const std::vector<float> q = signed_probabilities(0);
    for (int m : {1, 4, 15, 23, 32, 33, 64, 100}) {
        const BsplineTable table(m);
        CHECK((m > kMaxTableOrder) == (table.table_floor() > 0.5f));
        const std::vector<float> x = bulk(table, q);
        int compared = 0;
        for (std::size_t i = 0; i < q.size(); ++i) {
            if (std::abs(q[i]) >= table.table_floor()) continue;
            ++compared;
            CHECK(same_bits(x[i], static_cast<float>(exact_centred(m, q[i]))));
        }
        CHECK(compared > 50);
    }
}

TEST_CASE("an element's bits depend on it alone: not on count, place, neighbours or the scalar form") {
    std::vector<float> q = signed_probabilities(2);
    std::shuffle(q.begin(), q.end(), std::mt19937(7));
    for (int m : {1, 4, 15, 32, 40}) {
        const BsplineTable table(m);
        for_each_target([&](const char*) {
            const std::vector<float> whole = bulk(table, q);
            for (std::size_t count = 0; count <= 70; ++count) {
                for (std::size_t begin : {0, 1, 5, 16}) {
                    std::vector<float> x(count + 1, 12345.0f);
                    table.centred({q.data() + begin, count}, {x.data(), count});
                    const bool same =
                        std::equal(x.begin(), x.end() - 1, whole.begin() + static_cast<long>(begin), same_bits);
                    CHECK(same);
                    CHECK(x[count] == 12345.0f);
                }
            }
            std::size_t different = 0;
            for (std::size_t i = 0; i < q.size(); ++i) different += same_bits(table.centred(q[i]), whole[i]) ? 0 : 1;
            CHECK(different == 0);
        });
    }
}

TEST_CASE("the two tails mirror each other bit for bit, and the ends are the ends of the support") {
    const std::vector<float> q = signed_probabilities(3);
    for (int m : {1, 2, 3, 4, 15, 32, 100}) {
        const BsplineTable table(m);
        for_each_target([&](const char*) {
            const std::vector<float> x = bulk(table, q);
            std::size_t different = 0;
            for (std::size_t i = 0; i < q.size(); i += 2) different += same_bits(x[i], -x[i + 1]) ? 0 : 1;
            CHECK(different == 0);
            CHECK(table.centred(0.0f) == 0.5f * static_cast<float>(m));
            CHECK(table.centred(-0.0f) == -0.5f * static_cast<float>(m));
        });
    }
}

TEST_CASE("beyond one half, and for NaN, the table gives the centre") {
    const float infinity = std::numeric_limits<float>::infinity();
    for (int m : {4, 32, 40}) {
        const BsplineTable table(m);
        for_each_target([&](const char*) {
            for (float q : {0.5f, -0.5f, 0.75f, 3e38f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
                CAPTURE(q);
                CHECK(std::abs(table.centred(q)) <= 1e-13f);
            }
        });
    }
}

// Midpoints of equal strata are the least discrepant points: their image differs from the density's integral by half a
// stratum, plus what the table's error moves. Random samples could only show a hundred times as much.
TEST_CASE("samples by the table are distributed by the density: Kolmogorov-Smirnov on stratified points") {
    constexpr int kSamples = 1 << 16;
    std::vector<float> q(kSamples);
    for (int i = 0; i < kSamples; ++i) {
        const float y = (static_cast<float>(i) + 0.5f) / kSamples;
        q[static_cast<std::size_t>(i)] = i < kSamples / 2 ? -y : 1 - y;
    }
    double worst = 0;
    for (int m : {1, 2, 3, 4, 7, 15, 32, 60}) {
        const BsplineTable table(m);
        const std::vector<float> x = bulk(table, q);
        CHECK(std::is_sorted(x.begin(), x.end()));

        // Integrate the density from sample to sample and compare with their counts.
        const auto density = [m](double u) { return bspline_pdf(m, u + 0.5 * m); };
        const double bound = 0.5 / kSamples + kTableError * density(0) + 1e-12;
        constexpr std::size_t kStride = 64;
        double integral = 0;
        double from = -0.5 * m;
        for (std::size_t i = 0; i < q.size(); i += kStride) {
            const double to = x[i];
            integral += oracle::integrate(density, from, to);
            from = to;
            const double below = static_cast<double>(i) / kSamples;
            const double deviation = std::max(std::abs(integral - below), std::abs(integral - below - 1.0 / kSamples));
            CAPTURE(m);
            CAPTURE(i);
            REQUIRE(deviation <= bound);
            worst = std::max(worst, deviation / bound);
        }
    }
    MESSAGE("max observed / bound: " << worst);
}
