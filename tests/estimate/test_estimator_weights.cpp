#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "src/estimate/estimator_weights.h"
#include "src/filter/bspline.h"

using strata::estimate::BsplineWeights;
using strata::estimate::kWeightError;
using strata::filter::bspline_pdf;

TEST_CASE("weights of a position are the B-spline's density at every pixel that sees it, and none is left out") {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    double worst = 0;
    double worst_sum = 0;
    for (int m = 1; m <= 100; m += m < 12 ? 1 : 8) {
        const BsplineWeights weights(m);
        std::vector<double> w(static_cast<std::size_t>(m));
        for (int trial = 0; trial < 300; ++trial) {
            const float fraction = trial == 0   ? 0.0f
                                   : trial == 1 ? 0.5f
                                   : trial == 2 ? 0x1.fffffep-1f
                                   : trial == 3 ? 0x1.fffffep-2f
                                                : std::min(uniform(engine), 0x1.fffffep-1f);
            const int first = weights.at_fraction(fraction, w.data());
            double sum = 0;
            for (const double weight : w) {
                REQUIRE(weight >= 0);
                sum += weight;
            }
            worst_sum = std::max(worst_sum, std::fabs(sum - 1));
            for (int pixel = -weights.reach() - 2; pixel <= weights.reach() + 2; ++pixel) {
                const double x = static_cast<double>(fraction) - (pixel + 0.5) + 0.5 * m;
                const bool listed = pixel >= first && pixel < first + m;
                if (listed) REQUIRE(std::abs(pixel) <= weights.reach());
                const double weight = listed ? w[static_cast<std::size_t>(pixel - first)] : 0.0;
                worst = std::max(worst, std::fabs(weight - bspline_pdf(m, x)));
            }
        }
    }
    MESSAGE("error of a weight: ", worst / kWeightError, " of its bound; of their sum: ", worst_sum);
    CHECK(worst <= kWeightError);
    CHECK(worst_sum <= 10 * kWeightError);
}

TEST_CASE("the density at a point agrees with the exact one and vanishes outside the support") {
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> uniform(-0.1, 1.1);
    double worst = 0;
    for (int m = 1; m <= 100; m += m < 12 ? 1 : 8) {
        const BsplineWeights weights(m);
        for (int trial = 0; trial < 500; ++trial) {
            const double x = m * uniform(engine);
            worst = std::max(worst, std::fabs(weights.at(x) - bspline_pdf(m, x)));
        }
        CHECK(weights.at(-1e-9) == 0);
        CHECK(weights.at(m + 1e-9) == 0);
    }
    MESSAGE("error of the density: ", worst / kWeightError, " of its bound");
    CHECK(worst <= kWeightError);
}
