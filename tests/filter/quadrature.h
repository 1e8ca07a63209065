// Quadrature of piecewise polynomials whose knots are multiples of one half: exact to rounding up to degree 59, and to
// far below it for smooth pieces of higher degree.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace oracle {

template <class F>
double integrate(F f, double a, double b) {
    double sum = 0;
    while (a < b) {
        const double end = std::min(b, 0.5 * std::floor(2 * a) + 0.5);
        sum += boost::math::quadrature::gauss<double, 30>::integrate(f, a, end);
        a = end;
    }
    return sum;
}

}  // namespace oracle
