// The checkered plane under a separable filter. At b px below the horizon the picture is a square wave in u, of half
// period p = b square / height, whose sign changes from row to row of squares:
//
//   pixel = 1/2 + 1/2 integral over b of n_m(b - centre) sign(b) S(b),   S(b) = the square wave under n_m in u
//
// S has a closed form. n_m is the m-th central difference of x_+^(m-1)/(m-1)!, so that S is the m-th difference of the
// square wave's m-fold integral, the periodic Euler function p^m E_m(x/p)/m! (Abramowitz & Stegun 23.1), and
// |S| <= (4/pi) (2p/pi)^m (23.1.14). That bound tells how near the horizon the integral over b may stop.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/filter/bspline.h"
#include "tools/converge/quadrature.h"
#include "tools/converge/truth.h"

namespace strata::tools::converge {

namespace {

constexpr double kRemainder = 2e-7;    // of a pixel, left out next to the horizon
constexpr double kMostSegments = 1e6;  // of a column

// The square wave, +1 on [0,1), -1 on [1,2) and so on, times p, under the centred n_m about x.
class FilteredSquareWave {
  public:
    explicit FilteredSquareWave(int m) : m_(m), differences_(static_cast<std::size_t>(m) + 1), euler_(euler(m)) {
        differences_[0] = 1;
        for (int j = 1; j <= m; ++j) {
            differences_[static_cast<std::size_t>(j)] =
                -differences_[static_cast<std::size_t>(j - 1)] * (m - j + 1) / j;
        }
    }

    double at(double x, double p) const { return p <= 1 ? by_differences(x, p) : by_stripes(x, p); }

  private:
    // Coefficients of E_m(x)/m!, constant term first: E_n' = n E_(n-1), and E_n(0) + E_n(1) = 0 for n > 0.
    static std::vector<double> euler(int m) {
        std::vector<double> c{1};
        for (int n = 1; n <= m; ++n) {
            std::vector<double> next(static_cast<std::size_t>(n) + 1);
            double at_one = 0;
            for (std::size_t k = 1; k < next.size(); ++k) at_one += next[k] = c[k - 1] / static_cast<double>(k);
            next[0] = -0.5 * at_one;
            c = next;
        }
        return c;
    }

    double periodic_euler(double x) const {
        const double whole = std::floor(x);
        const double fraction = x - whole;
        double value = 0;
        for (std::size_t k = euler_.size(); k-- > 0;) value = value * fraction + euler_[k];
        return std::fmod(whole, 2.0) == 0 ? value : -value;
    }

    double by_differences(double x, double p) const {
        double sum = 0;
        for (int j = 0; j <= m_; ++j) {
            sum += differences_[static_cast<std::size_t>(j)] * periodic_euler((x + 0.5 * m_ - j) / p);
        }
        return std::pow(p, m_) * sum;
    }

    double by_stripes(double x, double p) const {
        const double half = 0.5 * m_;
        const auto first = static_cast<long long>(std::floor((x - half) / p));
        const auto last = static_cast<long long>(std::floor((x + half) / p));
        double sum = 0;
        for (long long k = first; k <= last; ++k) {
            const double from = filter::bspline_cdf(m_, static_cast<double>(k) * p - x + half);
            const double to = filter::bspline_cdf(m_, static_cast<double>(k + 1) * p - x + half);
            sum += k % 2 == 0 ? to - from : from - to;
        }
        return sum;
    }

    int m_;
    std::vector<double> differences_;  // (-1)^j binomial(m, j)
    std::vector<double> euler_;
};

struct Plane {
    double horizon;      // px
    double first_row;    // row number times b: px
    double half_period;  // over b
};

// All b in [low,high] where the integrand is not smooth: rows of squares, knots of the pixels' filters, and where a
// column's edge passes a knot of the filter in u about x.
std::vector<double> breaks(const Plane& plane, int m, double x, double low, double high) {
    std::vector<double> at{low, high};
    const auto add_series = [&](double numerator) {
        for (double k = std::max(1.0, std::ceil(numerator / high)); numerator / k > low; ++k)
            at.push_back(numerator / k);
    };
    add_series(plane.first_row);
    for (int j = 0; j <= m; ++j) add_series(std::fabs(x + 0.5 * m - j) / plane.half_period);
    // Even orders have their knots at pixel centres, odd ones at borders.
    const double offset = m % 2 == 0 ? 0.5 : 0.0;
    for (double v = std::ceil(plane.horizon + low - offset) + offset; v < plane.horizon + high; ++v) {
        at.push_back(v - plane.horizon);
    }
    std::sort(at.begin(), at.end());
    return at;
}

// b below which all that is left out of a pixel stays below kRemainder.
double least_b(const Plane& plane, int m) {
    const double scale = 2 / std::numbers::pi * std::pow(2 * plane.half_period / std::numbers::pi, m) / (m + 1);
    return std::pow(kRemainder / scale, 1.0 / (m + 1));
}

class CheckerColumn {
  public:
    CheckerColumn(const Plane& plane, int m, const film::Rect& window)
        : plane_(plane), m_(m), window_(window), wave_(m), rule_(8 + m / 2) {}

    // Adds the pixels of the column about x px right of the frame's middle to sums, one a row.
    void add(double x, double low, double high, std::vector<double>& sums) const {
        const std::vector<double> at = breaks(plane_, m_, x, low, high);
        for (std::size_t i = 1; i < at.size(); ++i) {
            if (at[i] > at[i - 1]) add_segment(x, at[i - 1], at[i], sums);
        }
    }

  private:
    void add_segment(double x, double from, double to, std::vector<double>& sums) const {
        const double middle = 0.5 * (from + to);
        const double half = 0.5 * (to - from);
        const double sign = std::fmod(std::floor(plane_.first_row / middle), 2.0) == 0 ? 1 : -1;
        const double v = plane_.horizon + middle;
        const int first = std::max(window_.y0, static_cast<int>(std::floor(v - 0.5 - 0.5 * m_)));
        const int last = std::min(window_.y1, static_cast<int>(std::ceil(v + 0.5 + 0.5 * m_)));
        if (first >= last) return;
        for (std::size_t i = 0; i < rule_.nodes.size(); ++i) {
            const double b = middle + half * rule_.nodes[i];
            const double wave = half * rule_.weights[i] * sign * wave_.at(x, plane_.half_period * b);
            for (int y = first; y < last; ++y) {
                sums[static_cast<std::size_t>(y - window_.y0)] +=
                    wave * filter::bspline_pdf(m_, plane_.horizon + b - (y + 0.5) + 0.5 * m_);
            }
        }
    }

    const Plane& plane_;
    int m_;
    const film::Rect& window_;
    FilteredSquareWave wave_;
    GaussLegendre rule_;
};

}  // namespace

std::optional<Truth> exact_checker(const scene::Checker& checker, const scene::Film& film, int m,
                                   const film::Rect& window) {
    const Plane plane{checker.horizon * film.height, film.width * checker.height / checker.square,
                      checker.square / checker.height};
    const double high = window.y1 + 0.5 * m - plane.horizon;
    const double low = std::max(least_b(plane, m), window.y0 - 0.5 * m - plane.horizon);
    const auto columns = static_cast<std::size_t>(window.width());
    const auto rows = static_cast<std::size_t>(window.height());
    Truth truth{std::vector<double>(columns * rows, 0.5), 1.1 * kRemainder,
                "closed form along rows, Gauss-Legendre quadrature between the breaks along columns; left out next to "
                "the horizon: below 2e-7"};
    if (!(high > low)) return truth;
    const double widest = 0.5 * film.width + m;
    if ((plane.first_row + (m + 1) * widest / plane.half_period) / low > kMostSegments) return std::nullopt;
    const CheckerColumn column(plane, m, window);
    std::vector<double> sums(rows);
    for (std::size_t x = 0; x < columns; ++x) {
        std::fill(sums.begin(), sums.end(), 0.0);
        column.add(window.x0 + static_cast<double>(x) + 0.5 - 0.5 * film.width, low, high, sums);
        for (std::size_t y = 0; y < rows; ++y) truth.grey[y * columns + x] += 0.5 * sums[y];
    }
    return truth;
}

}  // namespace strata::tools::converge
