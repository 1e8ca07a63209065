// How far a batch's results are from the oracle's, against the stated bounds.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "noise/float_error.h"
#include "tests/noise/batch_case.h"
#include "tests/noise/oracle_jet.h"

namespace strata::noise::test {

template <std::size_t D>
std::array<long double, D> position(const Offsets<D>& offsets, std::size_t i) {
    std::array<long double, D> x;
    for (std::size_t a = 0; a < D; ++a) x[a] = static_cast<long double>(offsets[a][i]);
    return x;
}

// As FloatErrors: the largest of the gradient's components, its length, the largest of the Hessian's entries.
struct Errors {
    double value = 0.0, axis = 0.0, slope = 0.0, entry = 0.0;
};

inline Errors larger(const Errors& a, const Errors& b) {
    return {std::max(a.value, b.value), std::max(a.axis, b.axis), std::max(a.slope, b.slope),
            std::max(a.entry, b.entry)};
}

template <std::size_t D, class Found>
Errors difference(const Dual2<D>& expected, const Found& found) {
    Errors e;
    long double slope = 0;
    e.value = static_cast<double>(std::abs(found.value - expected.value));
    for (std::size_t a = 0; a < D; ++a) {
        const long double axis = std::abs(found.gradient[a] - expected.gradient[a]);
        slope += axis * axis;
        e.axis = std::max(e.axis, static_cast<double>(axis));
        for (std::size_t b = 0; b < D; ++b) {
            const long double entry = std::abs(found.hessian[a][b] - expected.hessian[a][b]);
            e.entry = std::max(e.entry, static_cast<double>(entry));
        }
    }
    e.slope = static_cast<double>(std::sqrt(slope));
    return e;
}

template <std::size_t D>
Dual2<D> point_of(const Output<D>& output, std::size_t i) {
    Dual2<D> jet(static_cast<long double>(output.value[i]));
    for (std::size_t a = 0; a < D; ++a) {
        jet.gradient[a] = static_cast<long double>(output.gradient[a][i]);
        for (std::size_t b = 0; b < D; ++b)
            jet.hessian[a][b] = static_cast<long double>(output.hessian[entry<D>(a, b)][i]);
    }
    return jet;
}

template <std::size_t D>
void check_within(const Errors& worst, const std::string& what) {
    const FloatErrors& bound = kFloatErrors<D>;
    CHECK(worst.value <= bound.value);
    CHECK(worst.axis <= bound.gradient_axis);
    CHECK(worst.slope <= bound.slope);
    CHECK(worst.entry <= bound.hessian_entry);
    MESSAGE(what << ", of the bounds: value " << worst.value / bound.value << ", component "
                 << worst.axis / bound.gradient_axis << ", slope " << worst.slope / bound.slope << ", Hessian "
                 << worst.entry / bound.hessian_entry);
}

}  // namespace strata::noise::test
