// B-splines by truncated powers, (A.3) and (A.4) of Gamito & Maddock 2006, in 400-bit arithmetic: the alternating sums
// lose at most about 75 digits of 120 on the lower half at order 100.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace oracle {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<400, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

struct Spline {
    Real cdf = 0;
    Real pdf = 0;
    Real derivative = 0;  // right-continuous
};

inline Real integer_power(Real base, int exponent) {
    Real result = 1;
    for (; exponent > 0; exponent >>= 1) {
        if (exponent & 1) result *= base;
        base *= base;
    }
    return result;
}

inline Spline spline(int m, const Real& x) {
    Spline sum;
    Real binomial = 1;
    for (int k = 0; k <= m && k <= x; ++k) {
        const Real signed_binomial = k % 2 == 0 ? binomial : Real(-binomial);
        const Real base = x - k;
        const Real term = signed_binomial * integer_power(base, std::max(m - 2, 0));
        sum.derivative += term;
        sum.pdf += m > 1 ? Real(term * base) : term;
        sum.cdf += m > 1 ? Real(term * base * base) : Real(term * base);
        binomial = binomial * (m - k) / (k + 1);
    }
    Real factorial = 1;
    for (int k = 2; k <= m - 2; ++k) factorial *= k;
    sum.derivative = m > 1 ? Real(sum.derivative / factorial) : Real(0);
    if (m > 2) factorial *= m - 1;
    sum.pdf /= factorial;
    if (m > 1) factorial *= m;
    sum.cdf /= factorial;
    return sum;
}

}  // namespace oracle
