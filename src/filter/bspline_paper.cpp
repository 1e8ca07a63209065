#include "src/filter/bspline_paper.h"

#include <algorithm>
#include <cmath>

#include "src/filter/bspline.h"

namespace strata::filter::paper {

namespace {

struct Values {
    double cdf;
    double pdf;
};

// Both from the same two recursive calls, which is how the paper halves the cost.
Values values_at(int m, double x) {
    if (m == 1) return {cdf(1, x), pdf(1, x)};
    const double here = cdf(m - 1, x);
    const double shifted = cdf(m - 1, x - 1);
    return {x / m * here + (1 - x / m) * shifted, here - shifted};
}

template <class Evaluate>
PaperInversion newton(int m, double y, double tolerance, int max_iterations, Evaluate evaluate) {
    PaperInversion result;
    result.x = 0.5 * m;
    while (result.iterations < max_iterations) {
        const Values values = evaluate(m, result.x);
        const double step = (values.cdf - y) / values.pdf;
        ++result.iterations;
        if (!std::isfinite(step)) break;
        result.x -= step;
        if (std::abs(step) < tolerance) {
            result.converged = true;
            break;
        }
    }
    return result;
}

}  // namespace

double cdf(int m, double x) {
    if (m == 1) return std::clamp(x, 0.0, 1.0);
    return x / m * cdf(m - 1, x) + (1 - x / m) * cdf(m - 1, x - 1);
}

double pdf(int m, double x) {
    if (m == 1) return x >= 0 && x < 1 ? 1 : 0;
    return cdf(m - 1, x) - cdf(m - 1, x - 1);
}

PaperInversion inverse_cdf(int m, double y, double tolerance, int max_iterations) {
    return newton(m, y, tolerance, max_iterations, values_at);
}

PaperInversion inverse_cdf_fast(int m, double y, double tolerance, int max_iterations) {
    return newton(m, y, tolerance, max_iterations, [](int order, double x) {
        return Values{bspline_cdf(order, x), bspline_pdf(order, x)};
    });
}

}  // namespace strata::filter::paper
