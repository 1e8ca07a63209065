#include "src/estimate/estimator_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace strata::estimate {

namespace {

// n_m(k + f) for k = 0..m-1 and f in [0,1], as polynomials of f on each piece (so that f = 1 is the limit from the
// left): n_m(x) = (x n_{m-1}(x) + (m - x) n_{m-1}(x - 1)) / (m - 1), all terms positive.
std::vector<double> pieces(int m, double f) {
    std::vector<double> n(static_cast<std::size_t>(std::max(m, 1)), 0.0);
    n[0] = 1;
    for (int order = 2; order <= m; ++order) {
        for (int k = order - 1; k >= 0; --k) {
            const double own = k < order - 1 ? (k + f) * n[k] : 0.0;
            const double previous = k > 0 ? (order - k - f) * n[k - 1] : 0.0;
            n[k] = (own + previous) / (order - 1);
        }
    }
    return n;
}

// n_m' = n_{m-1}(x) - n_{m-1}(x - 1).
std::vector<double> piece_slopes(int m, double f) {
    std::vector<double> slope(static_cast<std::size_t>(m), 0.0);
    if (m == 1) return slope;
    const std::vector<double> lower = pieces(m - 1, f);
    for (int k = 0; k < m; ++k) slope[k] = (k < m - 1 ? lower[k] : 0.0) - (k > 0 ? lower[k - 1] : 0.0);
    return slope;
}

double evaluate(const double* c, std::size_t stride, double s) {
    return std::max(0.0, c[0] + s * (c[stride] + s * (c[2 * stride] + s * c[3 * stride])));
}

}  // namespace

BsplineWeights::BsplineWeights(int m) : m_(m), cells_(m <= 4 ? 1 : kWeightCells) {
    cubics_.resize(static_cast<std::size_t>(cells_) * 4 * stride(), 0.0);
    for (int cell = 0; cell < cells_; ++cell) tabulate(cell);
}

void BsplineWeights::tabulate(int cell) {
    const double h = 1.0 / cells_;
    const std::vector<double> n0 = pieces(m_, cell * h);
    const std::vector<double> n1 = pieces(m_, (cell + 1) * h);
    const std::vector<double> slope0 = piece_slopes(m_, cell * h);
    const std::vector<double> slope1 = piece_slopes(m_, (cell + 1) * h);
    const std::size_t S = stride();
    double* c = &cubics_[4 * S * static_cast<std::size_t>(cell)];
    for (int k = 0; k < m_; ++k, ++c) {
        const int piece = m_ - 1 - k;
        const double d0 = slope0[piece] * h;
        const double d1 = slope1[piece] * h;
        const double rise = n1[piece] - n0[piece];
        c[0] = n0[piece];
        c[S] = d0;
        c[2 * S] = 3 * rise - 2 * d0 - d1;
        c[3 * S] = d0 + d1 - 2 * rise;
    }
}

int BsplineWeights::at_fraction(float fraction, double* weights) const {
    const Cubics cubics = lookup(fraction);
    for (int k = 0; k < m_; ++k) weights[k] = evaluate(cubics.c + k, stride(), cubics.s);
    return cubics.first;
}

double BsplineWeights::at(double x) const {
    if (!(x >= 0 && x <= m_)) return 0;
    const int piece = std::min(static_cast<int>(x), m_ - 1);
    const double scaled = (x - piece) * cells_;
    const int cell = std::min(static_cast<int>(scaled), cells_ - 1);
    const std::size_t row = 4 * stride() * static_cast<std::size_t>(cell);
    return evaluate(&cubics_[row + static_cast<std::size_t>(m_ - 1 - piece)], stride(), scaled - cell);
}

}  // namespace strata::estimate
