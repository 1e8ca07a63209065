#include <doctest/doctest.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "src/render/confidence.h"

using namespace strata::render;

TEST_CASE("quantiles of the normal and of Student's distribution are Boost's") {
    const boost::math::normal normal;
    for (const double p : {1e-9, 1e-6, 0.001, 0.025, 0.3, 0.5, 0.7, 0.95, 0.975, 0.999, 1 - 1e-6}) {
        CAPTURE(p);
        CHECK(normal_quantile(p) == doctest::Approx(boost::math::quantile(normal, p)).epsilon(1e-10));
        for (const int dof : {1, 2, 3, 4, 5, 10, 31, 100, 1001}) {
            CAPTURE(dof);
            const double expected = boost::math::quantile(boost::math::students_t(dof), p);
            CHECK(std::fabs(student_quantile(p, dof) - expected) <= 1e-7 * std::fabs(expected) + 1e-9);
        }
    }
}
