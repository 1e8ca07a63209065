#include "src/filter/bspline.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace strata::filter {

namespace {

// k! for k = 0..100, accumulated in extended precision so that each entry is good to an ulp of double.
constexpr std::array<double, kMaxOrder + 1> kFactorial = [] {
    std::array<double, kMaxOrder + 1> table{};
    long double product = 1;
    for (int k = 0; k <= kMaxOrder; ++k) {
        if (k > 0) product *= k;
        table[static_cast<std::size_t>(k)] = static_cast<double>(product);
    }
    return table;
}();

double factorial(int k) { return kFactorial[static_cast<std::size_t>(k)]; }

// One order of the spline at x, x-1, x-2, ... down to the last point inside the support. The order is raised by
// (k-1) n_k(x) = x n_{k-1}(x) + (k-x) n_{k-1}(x-1), without the division: entry s of order k is (k-1)! n_k(x-s), and
// 99! is far from overflow.
class ShiftedValues {
  public:
    // Order 1: the box is 1 at x - floor(x) and 0 at the other points. Requires 0 <= x <= kMaxOrder/2.
    explicit ShiftedValues(double x) : x_(x), last_(static_cast<int>(x)) {
        std::fill_n(scaled_.begin(), last_ + 2, 0.0);
        scaled_[static_cast<std::size_t>(last_)] = 1.0;
    }

    void raise(int from, int to) {
        int k = from + 1;
        if ((to - from) % 2 != 0) raise_by_one(k++);
        for (; k < to; k += 2) raise_by_two(k);
    }

    double front() const { return scaled_[0]; }

    // At order m-1: (m-2)! n_m'(x), by n_m'(x) = n_{m-1}(x) - n_{m-1}(x-1).
    double difference() const { return scaled_[0] - scaled_[1]; }

    // At order m: (m-1)! N_m(x). N_m(x) is the sum of n_{m+1}(x-s) over s >= 0; expanding each term by the recurrence
    // leaves n_m(x) x/m + sum of n_m(x-s) over s >= 1.
    double integral(int m) const {
        double sum = 0;
        for (int s = last_; s >= 1; --s) sum += scaled_[static_cast<std::size_t>(s)];
        return sum + x_ / m * scaled_[0];
    }

  private:
    // From order k-1 to order k. Entries before last - k + 1 are outside the support.
    void raise_by_one(int k) {
        double* const v = scaled_.data();
        double next = 0;  // the lower order at s+1
        for (int s = last_; s >= std::max(0, last_ - k + 1); --s) {
            const double a = x_ - s;
            const double here = v[s];
            v[s] = a * here + (k - a) * next;
            next = here;
        }
    }

    // From order k-1 to order k+1 in one sweep: half the stores and reloads that the sweeps wait for.
    void raise_by_two(int k) {
        double* const v = scaled_.data();
        double next = 0;         // order k-1 at s+1
        double next_raised = 0;  // order k at s+1
        for (int s = last_; s >= std::max(0, last_ - k); --s) {
            const double a = x_ - s;
            const double here = v[s];
            const double raised = a * here + (k - a) * next;
            v[s] = a * raised + (k + 1 - a) * next_raised;
            next = here;
            next_raised = raised;
        }
    }

    double x_;
    int last_;
    std::array<double, kMaxOrder / 2 + 2> scaled_;
};

// N_m(x) for x in [0,m/2].
double lower_cdf(int m, double x) {
    ShiftedValues values(x);
    values.raise(1, m);
    return values.integral(m) / factorial(m - 1);
}

// What a root-finder needs of N_m at one point.
struct Local {
    double cdf_scaled;   // (m-1)! N
    double cdf_per_pdf;  // N / n
    double slope;        // n' / n
};

Local local_at(int m, double x) {
    ShiftedValues values(x);
    values.raise(1, m - 1);
    const double difference = values.difference();
    values.raise(m - 1, m);
    const double cdf = values.integral(m);
    const double per_pdf = 1 / values.front();
    return {cdf, cdf * per_pdf, (m - 1) * difference * per_pdf};
}

// Standard normal quantile of p in (0,1/2], negative; absolute error < 4.5e-4 (Abramowitz & Stegun 26.2.23).
double normal_quantile(double log_p) {
    const double t = std::sqrt(-2 * log_p);
    const double numerator = 2.515517 + t * (0.802853 + t * 0.010328);
    const double denominator = 1 + t * (1.432788 + t * (0.189269 + t * 0.001308));
    return numerator / denominator - t;
}

// A step that leaves at most 1e-15 px by the bound of kHalleyCubic.
constexpr double kLastStep = 9e-6;
static_assert(kHalleyCubic * kLastStep * kLastStep * kLastStep <= 1e-15);

// Halley's method on N^(1/m), which is nearly linear in the tail. N is the volume of a corner of the unit cube: its
// m-th root is concave (Brunn-Minkowski), while N itself is convex on [0,m/2]. From any point the Newton steps of the
// two therefore enclose the root, and one of them lies beyond the point; [low,high], which must hold the root, shrinks
// to it whatever Halley does. There is no cap on iterations, and no need of one.
Inversion refine(int m, double p, double low, double high, double x) {
    const double p_scaled = p * factorial(m - 1);
    for (int iterations = 1;; ++iterations) {
        const Local local = local_at(m, x);
        const double r = local.cdf_per_pdf;
        const double ratio = p_scaled / local.cdf_scaled;
        const double concave_newton = m * r * std::expm1(std::log(ratio) / m);
        const double convex_newton = r * (ratio - 1);
        low = std::max(low, x + concave_newton);
        high = std::min(high, x + convex_newton);

        const double q = local.slope - (1 - 1.0 / m) / r;
        const double halley = concave_newton / (1 + 0.5 * concave_newton * q);
        // Rounding may cross the two ends by an ulp, so this is not std::clamp.
        x = std::max(low, std::min(high, x + halley));
        if (!(std::abs(halley) > kLastStep)) return {x, iterations};
    }
}

Inversion invert_tail(int m, double p) {
    if (std::isnan(p)) return {p, 0};
    p = std::clamp(p, 0.0, 0.5);
    if (p == 0) return {0, 0};
    if (m == 1) return {p, 0};
    if (m == 2) return {std::sqrt(2 * p), 0};
    // On [0,1], N_m(x) = x^m/m!; beyond, this bounds the root from below.
    const double tail = std::exp(std::log(p * factorial(m)) / m);
    if (tail <= 1) return {tail, 0};
    const double central = 0.5 * m + std::sqrt(m / 12.0) * normal_quantile(std::log(p));
    return refine(m, p, tail, 0.5 * m, std::clamp(central, tail, 0.5 * m));
}

}  // namespace

double bspline_pdf(int m, double x) {
    assert(m >= kMinOrder && m <= kMaxOrder);
    if (std::isnan(x)) return x;
    if (!(x >= 0 && x < m)) return 0;
    if (m == 1) return 1;
    ShiftedValues values(x <= 0.5 * m ? x : m - x);
    values.raise(1, m);
    return values.front() / factorial(m - 1);
}

double bspline_cdf(int m, double x) {
    assert(m >= kMinOrder && m <= kMaxOrder);
    if (std::isnan(x)) return x;
    if (x <= 0) return 0;
    if (x >= m) return 1;
    return x <= 0.5 * m ? lower_cdf(m, x) : 1 - lower_cdf(m, m - x);
}

double bspline_survival(int m, double x) {
    assert(m >= kMinOrder && m <= kMaxOrder);
    if (std::isnan(x)) return x;
    if (x <= 0) return 1;
    if (x >= m) return 0;
    return x <= 0.5 * m ? 1 - lower_cdf(m, x) : lower_cdf(m, m - x);
}

double bspline_inverse_tail(int m, double p) {
    assert(m >= kMinOrder && m <= kMaxOrder);
    return invert_tail(m, p).x;
}

Inversion bspline_invert(int m, double y) {
    assert(m >= kMinOrder && m <= kMaxOrder);
    if (!(y > 0.5)) return invert_tail(m, y);
    Inversion inversion = invert_tail(m, 1 - y);
    inversion.x = m - inversion.x;
    return inversion;
}

double bspline_inverse_cdf(int m, double y) { return bspline_invert(m, y).x; }

}  // namespace strata::filter
