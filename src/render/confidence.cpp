#include "src/render/confidence.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace strata::render {

namespace {

double normal_cdf(double z) { return 0.5 * std::erfc(-z * std::numbers::sqrt2 / 2); }

// P(|T| < tan(theta) sqrt(dof)), theta in [0, pi/2).
double student_within(double theta, int dof) {
    const double sine = std::sin(theta);
    const double cosine = std::cos(theta);
    const bool odd = dof % 2 == 1;
    double term = odd ? cosine : 1.0;
    double sum = 0;
    for (int k = odd ? 1 : 0; k <= dof - 2; k += 2) {
        sum += term;
        term *= cosine * cosine * (k + 1) / (k + 2);
    }
    return odd ? 2 / std::numbers::pi * (theta + sine * sum) : sine * sum;
}

// The root of an increasing function in [low,high] by bisection, to the last bit or so.
template <class Function>
double bisect(double low, double high, const Function& function) {
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (function(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

double normal_quantile(double p) {
    assert(p > 0 && p < 1);
    if (p > 0.5) return -normal_quantile(1 - p);
    return bisect(-40, 0, [p](double z) { return normal_cdf(z) - p; });
}

double student_quantile(double p, int dof) {
    assert(p > 0 && p < 1 && dof >= 1);
    if (p < 0.5) return -student_quantile(1 - p, dof);
    const double theta =
        bisect(0, 0.5 * std::numbers::pi, [&](double angle) { return student_within(angle, dof) - (2 * p - 1); });
    return std::tan(theta) * std::sqrt(static_cast<double>(dof));
}

}  // namespace strata::render
