// Proves the constants of bounds.h from above, by branch and bound over position and direction (method: bounds.h).
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "noise/bounds.h"
#include "noise/gradients.h"

namespace {

// Univariate polynomials of degree 6: t^3 (6 t^2 - 15 t + 10) times a linear factor.
constexpr std::size_t kCoefficients = 7;
using Polynomial = std::array<double, kCoefficients>;

Polynomial differentiate(const Polynomial& p) {
    Polynomial result{};
    for (std::size_t i = 1; i < kCoefficients; ++i) result[i - 1] = static_cast<double>(i) * p[i];
    return result;
}

Polynomial times_ramp(const Polynomial& p, double root) {
    Polynomial result{};
    for (std::size_t i = 0; i < kCoefficients; ++i) result[i] -= root * p[i];
    for (std::size_t i = 0; i + 1 < kCoefficients; ++i) result[i + 1] += p[i];
    return result;
}

// Bernstein coefficients on [lo, hi]: coefficient i is the polar form at i times hi and 6 - i times lo.
Polynomial bernstein(const Polynomial& p, double lo, double hi) {
    Polynomial result{};
    for (std::size_t i = 0; i < kCoefficients; ++i) {
        // symmetric[m] becomes the elementary symmetric polynomial of degree m of the six arguments.
        std::array<double, kCoefficients> symmetric{1.0};
        for (std::size_t n = 1; n < kCoefficients; ++n) {
            const double argument = n <= i ? hi : lo;
            for (std::size_t m = n; m > 0; --m) symmetric[m] += argument * symmetric[m - 1];
        }
        constexpr std::array<double, kCoefficients> kBinomial6 = {1, 6, 15, 20, 15, 6, 1};
        for (std::size_t m = 0; m < kCoefficients; ++m) result[i] += p[m] * symmetric[m] / kBinomial6[m];
    }
    return result;
}

double support(const std::array<double, 2>& v) {
    const double a = std::abs(v[0]), b = std::abs(v[1]);
    return double{strata::noise::kGradientLong} * std::max(a, b) +
           double{strata::noise::kGradientShort} * std::min(a, b);
}

double support(const std::array<double, 3>& v) {
    const double a = std::abs(v[0]), b = std::abs(v[1]), c = std::abs(v[2]);
    return a + b + c - std::min({a, b, c});
}

double distance_of_span(const std::array<std::array<double, 2>, 2>& d) {
    const double x = d[1][0] - d[0][0], y = d[1][1] - d[0][1];
    return std::abs(d[0][0] * y - d[0][1] * x) / std::hypot(x, y);
}

double distance_of_span(const std::array<std::array<double, 3>, 3>& d) {
    std::array<double, 3> e, f;
    for (std::size_t a = 0; a < 3; ++a) {
        e[a] = d[1][a] - d[0][a];
        f[a] = d[2][a] - d[0][a];
    }
    const std::array<double, 3> n = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
    return std::abs(n[0] * d[0][0] + n[1] * d[0][1] + n[2] * d[0][2]) / std::hypot(n[0], n[1], n[2]);
}

// Multi-indices (o_0 .. o_{D-1}) with sum k.
template <int D>
std::vector<std::array<std::size_t, D>> multi_indices(std::size_t k) {
    std::vector<std::array<std::size_t, D>> result;
    for (std::size_t x = 0; x <= k; ++x) {
        if constexpr (D == 2) {
            result.push_back({x, k - x});
        } else {
            for (std::size_t y = 0; x + y <= k; ++y) result.push_back({x, y, k - x - y});
        }
    }
    return result;
}

// Proves: sum over corners of sigma(v_c) <= limit for the derivative of order k, everywhere.
template <int D>
class Certificate {
  public:
    using Vector = std::array<double, D>;
    using Simplex = std::array<Vector, D>;  // unit directions; stands for all unit vectors of the cone they span

    Certificate(std::size_t k, double limit) : k_(k), limit_(limit), orders_(multi_indices<D>(k)) {
        const std::array<Polynomial, 2> weights = {Polynomial{1, 0, 0, -10, 15, -6}, Polynomial{0, 0, 0, 10, -15, 6}};
        for (std::size_t side = 0; side < 2; ++side) {
            const std::array<Polynomial, 2> factors = {weights[side],
                                                       times_ramp(weights[side], static_cast<double>(side))};
            for (std::size_t ramped = 0; ramped < 2; ++ramped) {
                Polynomial p = factors[ramped];
                for (std::size_t order = 0; order < 4; ++order, p = differentiate(p)) factors_[side][ramped][order] = p;
            }
        }
    }

    // Noise, gradients and cube share the symmetries of the cell: positions with x <= y (<= z) <= 1/2 stand for all,
    // and of d and -d one is enough.
    bool prove() {
        Vector hi;
        hi.fill(0.5);
        bool proven = true;
        for (unsigned octant = 0; octant < (k_ == 0 ? 1u : 1u << (D - 1)); ++octant) {
            Simplex directions{};
            for (std::size_t a = 0; a < D; ++a) directions[a][a] = (octant >> a) & 1 ? -1.0 : 1.0;
            proven = proven && prove(Vector{}, hi, directions);
        }
        return proven;
    }

    long boxes() const { return boxes_; }

  private:
    static constexpr double kSmallestSide = 1e-6;                                           // where to give up
    using Tables = std::array<std::array<std::array<std::array<Polynomial, 4>, 2>, 2>, D>;  // axis, side, ramped, order

    bool prove(const Vector& lo, const Vector& hi, const Simplex& directions) {
        for (std::size_t a = 0; a + 1 < D; ++a)
            if (lo[a] >= hi[a + 1]) return true;  // outside the wedge
        ++boxes_;
        if (bounded(lo, hi, directions)) return true;

        // Halve the longest side, of the box or of the simplex.
        std::size_t axis = 0;
        for (std::size_t a = 1; a < D; ++a)
            if (hi[a] - lo[a] > hi[axis] - lo[axis]) axis = a;
        double longest = 0.0;
        std::size_t from = 0, to = 0;
        for (std::size_t i = 0; k_ > 0 && i < D; ++i) {
            for (std::size_t j = i + 1; j < D; ++j) {
                double squared = 0.0;
                for (std::size_t a = 0; a < D; ++a) squared += std::pow(directions[i][a] - directions[j][a], 2);
                if (squared > longest * longest) longest = std::sqrt(squared), from = i, to = j;
            }
        }
        if (std::max(hi[axis] - lo[axis], longest) < kSmallestSide) return false;
        if (hi[axis] - lo[axis] >= longest) {
            Vector lower_hi = hi, upper_lo = lo;
            lower_hi[axis] = upper_lo[axis] = 0.5 * (lo[axis] + hi[axis]);
            return prove(lo, lower_hi, directions) && prove(upper_lo, hi, directions);
        }
        Vector middle;
        double squared = 0.0;
        for (std::size_t a = 0; a < D; ++a) {
            middle[a] = directions[from][a] + directions[to][a];
            squared += middle[a] * middle[a];
        }
        for (double& x : middle) x /= std::sqrt(squared);
        Simplex first = directions, second = directions;
        first[to] = second[from] = middle;
        return prove(lo, hi, first) && prove(lo, hi, second);
    }

    // Whether the Bernstein coefficients on this box and cone keep the sum within the limit.
    bool bounded(const Vector& lo, const Vector& hi, const Simplex& directions) const {
        Tables tables;
        for (std::size_t a = 0; a < D; ++a)
            for (std::size_t side = 0; side < 2; ++side)
                for (std::size_t ramped = 0; ramped < 2; ++ramped)
                    for (std::size_t order = 0; order < 4; ++order)
                        tables[a][side][ramped][order] = bernstein(factors_[side][ramped][order], lo[a], hi[a]);
        const std::vector<std::vector<double>> polar = polar_directions(directions);

        // A unit vector of the cone is sum lambda_i d_i with sum lambda_i <= 1 / (distance of the d_i's plane from 0),
        // and v_c is homogeneous of degree k. Rounding: the coefficients sum terms below 1e4 of relative error below
        // 1e-14, in all less than 1e-9 of any limit here.
        const double scale = k_ == 0 ? 1.0 : std::pow(distance_of_span(directions), static_cast<double>(k_));
        const double limit = limit_ * scale * (1.0 - 1e-9);

        std::array<std::size_t, D> index{};
        std::size_t a = 0;
        while (a < D) {
            if (!(largest_sum(tables, polar, index) <= limit)) return false;
            for (a = 0; a < D && ++index[a] == kCoefficients; ++a) index[a] = 0;
        }
        return true;
    }

    // polar[v][o]: factor of the partial derivative of multi-order orders_[o] in the polar form of d -> D^k(d, .., d)
    // at the vertices that multi-index orders_[v] counts.
    std::vector<std::vector<double>> polar_directions(const Simplex& directions) const {
        std::vector<std::vector<double>> polar(orders_.size(), std::vector<double>(orders_.size()));
        std::size_t sequences = 1;
        for (std::size_t i = 0; i < k_; ++i) sequences *= D;
        for (std::size_t v = 0; v < orders_.size(); ++v) {
            for (std::size_t sequence = 0; sequence < sequences; ++sequence) {
                std::array<std::size_t, D> order{};
                double product = 1.0;
                std::size_t digits = sequence;
                for (std::size_t vertex = 0; vertex < D; ++vertex) {
                    for (std::size_t n = 0; n < orders_[v][vertex]; ++n, digits /= D) {
                        ++order[digits % D];
                        product *= directions[vertex][digits % D];
                    }
                }
                const auto found = std::find(orders_.begin(), orders_.end(), order);
                polar[v][static_cast<std::size_t>(found - orders_.begin())] += product;
            }
        }
        return polar;
    }

    // max over direction coefficients of sum_c sigma(b_c), at one coefficient of the position box.
    double largest_sum(const Tables& tables, const std::vector<std::vector<double>>& polar,
                       const std::array<std::size_t, D>& index) const {
        constexpr std::size_t kMaxOrders = 10;
        std::array<double, kMaxOrders> sums{};
        for (std::size_t corner = 0; corner < (1u << D); ++corner) {
            std::array<Vector, kMaxOrders> partial;  // of W_c (p - c), by multi-order
            for (std::size_t o = 0; o < orders_.size(); ++o) {
                for (std::size_t component = 0; component < D; ++component) {
                    double product = 1.0;
                    for (std::size_t a = 0; a < D; ++a)
                        product *= tables[a][(corner >> a) & 1][a == component][orders_[o][a]][index[a]];
                    partial[o][component] = product;
                }
            }
            for (std::size_t v = 0; v < orders_.size(); ++v) {
                Vector b{};
                for (std::size_t o = 0; o < orders_.size(); ++o)
                    for (std::size_t component = 0; component < D; ++component)
                        b[component] += polar[v][o] * partial[o][component];
                sums[v] += support(b);
            }
        }
        return *std::max_element(sums.begin(), sums.end());
    }

    std::size_t k_;
    double limit_;
    std::vector<std::array<std::size_t, D>> orders_;
    std::array<std::array<std::array<Polynomial, 4>, 2>, 2> factors_;  // side, ramped, order of derivative
    long boxes_ = 0;
};

template <int D>
void certify(const strata::noise::NoiseBounds& bounds) {
    const std::array<double, 4> limits = {bounds.value, bounds.gradient, bounds.second, bounds.third};
    for (std::size_t k = 0; k < limits.size(); ++k) {
        Certificate<D> certificate(k, limits[k]);
        CHECK_MESSAGE(certificate.prove(), D << "-D order " << k << ": not proven <= " << limits[k]);
        MESSAGE(D << "-D, derivative of order " << k << " <= " << limits[k] << ": " << certificate.boxes() << " boxes");
    }
}

}  // namespace

TEST_CASE("no choice of gradients, position and direction exceeds the bounds of 2-D noise") {
    certify<2>(strata::noise::kBounds2);
}

TEST_CASE("no choice of gradients, position and direction exceeds the bounds of 3-D noise") {
    certify<3>(strata::noise::kBounds3);
}

TEST_CASE("the certificate refuses bounds a thousandth too small") {
    CHECK_FALSE(Certificate<2>(2, 0.999 * strata::noise::kBounds2.second).prove());
    CHECK_FALSE(Certificate<3>(0, 0.999 * strata::noise::kBounds3.value).prove());
}
