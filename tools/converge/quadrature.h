// Gauss-Legendre quadrature.
#pragma once

#include <vector>

namespace strata::tools::converge {

// Nodes ascending in (-1,1) and their weights, exact for polynomials up to degree 2n - 1.
struct GaussLegendre {
    explicit GaussLegendre(int n);

    // The integral of function over [low,high].
    template <class Function>
    auto integrate(double low, double high, const Function& function) const {
        const double middle = 0.5 * (low + high);
        const double half = 0.5 * (high - low);
        auto sum = 0.0 * function(middle);
        for (std::size_t i = 0; i < nodes.size(); ++i) sum += weights[i] * function(middle + half * nodes[i]);
        return half * sum;
    }

    std::vector<double> nodes, weights;
};

}  // namespace strata::tools::converge
