#include "tools/converge/quadrature.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace strata::tools::converge {

namespace {

struct Legendre {
    double value, derivative;
};

// P_n and its derivative at x in (-1,1), by the three-term recurrence.
Legendre legendre(int n, double x) {
    double previous = 1;
    double current = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
        previous = current;
        current = next;
    }
    return {current, n * (x * current - previous) / (x * x - 1)};
}

}  // namespace

GaussLegendre::GaussLegendre(int n) : nodes(static_cast<std::size_t>(n)), weights(static_cast<std::size_t>(n)) {
    for (int i = 0; i < n; ++i) {
        // Tricomi's first guess; Newton's iteration doubles its digits each time.
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        for (int step = 0; step < 6; ++step) {
            const Legendre p = legendre(n, x);
            x -= p.value / p.derivative;
        }
        const double slope = n == 1 ? 1.0 : legendre(n, x).derivative;
        nodes[static_cast<std::size_t>(i)] = n == 1 ? 0.0 : x;
        weights[static_cast<std::size_t>(i)] =
            2 / ((1 - nodes[static_cast<std::size_t>(i)] * nodes[static_cast<std::size_t>(i)]) * slope * slope);
    }
}

}  // namespace strata::tools::converge
