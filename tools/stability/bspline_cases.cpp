// The B-spline's values and inverse, in double and by the float table, against exact integers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/filter/bspline.h"
#include "src/filter/bspline_table.h"
#include "src/sample/strata.h"
#include "tools/stability/case.h"
#include "tools/stability/oracles/exact_bspline.h"

namespace strata::tools::stability {

namespace {

using oracle::exact_spline;

constexpr double kEps = 0x1p-52;

std::vector<int> orders(const Settings& settings, int low, int high) {
    std::vector<int> chosen;
    for (const int m : {1, 2, 3, 4, 5, 8, 15, 20, 32, 33, 50, 100}) {
        if (settings.fast && m >= low && m <= high) chosen.push_back(m);
    }
    for (int m = low; m <= high && !settings.fast; ++m) chosen.push_back(m);
    return chosen;
}

// How far x in [0,m/2] is from where N_m(x) = p. Near 0, where N_m(x) = x^m / m!, in closed form; beyond by one Newton
// step in long double, whose own error, second order in a distance below 1e-5, is below 1e-10 of it.
double tail_error(int m, long double x, long double p) {
    long double log_power = std::log(p);
    for (int k = 2; k <= m; ++k) log_power += std::log(static_cast<long double>(k));
    if (log_power <= 0.0L || x <= 0.5L) return static_cast<double>(std::abs(x - std::exp(log_power / m)));
    const oracle::ExactSpline at = exact_spline(m, static_cast<double>(x));
    return static_cast<double>(std::abs((at.cdf - p) / at.pdf));
}

// The largest N / n of the lower half: that at its centre, since N is log-concave.
double largest_ratio(int m) { return 0.5 / static_cast<double>(exact_spline(m, 0.5 * m).pdf); }

// Of the inverse in double: N / n carries the contract of both, 16 eps each, and p (m-1)! two roundings; the last
// Halley step leaves 1e-15; an upper coordinate is m - x, rounded. No more than the header's contract.
double inverse_bound(int m) {
    return std::min(filter::kInverseError, 36 * kEps * largest_ratio(m) + 1e-15 + 0.5 * kEps * m);
}

std::vector<double> tails(int m, const Settings& settings, Random& random) {
    std::vector<double> p{std::numeric_limits<double>::denorm_min(),
                          1e-300,
                          1e-100,
                          1e-30,
                          0x1p-53,
                          1e-8,
                          1e-3,
                          std::nextafter(0.5, 0.0),
                          0.5};
    std::uniform_real_distribution<double> exponent(-300.0, -0.4), uniform(0.0, 0.5);
    for (int i = 0; i < settings.trials(5, 2); ++i) p.push_back(std::pow(10.0, exponent(random)));
    for (int i = 0; i < settings.trials(5, 2); ++i) p.push_back(uniform(random));
    for (int knot = 1; knot <= m / 2; knot += 1 + m / 6) {
        const double at = std::min(0.5, filter::bspline_cdf(m, knot));
        p.insert(p.end(), {std::nextafter(at, 0.0), at, std::nextafter(at, 0.5)});
    }
    return p;
}

std::vector<Row> inverse_in_double(int low, int high, const Settings& settings, Random& random) {
    Worst lower, upper;
    for (const int m : orders(settings, low, high)) {
        const double bound = inverse_bound(m);
        for (const double p : tails(m, settings, random)) {
            if (settings.cancelled()) return {};
            const auto where = [&] { return fmt::format("echo {:.17g} | strata probe bspline -m {}", p, m); };
            lower.see(tail_error(m, filter::bspline_inverse_cdf(m, p), p) / bound, where);
            const double y = 1.0 - p;  // rounded; 1 - y is exact
            if (y == 1.0) continue;
            const double tail = m - filter::bspline_inverse_cdf(m, y);  // exact, as x lies in [m/2,m]
            upper.see(tail_error(m, tail, 1.0 - y) / bound,
                      [&] { return fmt::format("echo {:.17g} | strata probe bspline -m {}", y, m); });
        }
    }
    const double px = inverse_bound(high);
    const std::string name = fmt::format("inverse in double, m = {}..{}", low, high);
    return {check(name + ", y from 5e-324", lower.value() * px, px, "px", lower.where()),
            check(name + ", y up to 1 - 2^-53", upper.value() * px, px, "px", upper.where())};
}

// N = 64 strata through the float table. The folded probability has three roundings (stratum and jitter added, the
// jitter itself, the quotient), each 2^-24 of itself, worth N / n times as much in px; then the table's contract, or
// above its orders one rounding of the distance.
std::vector<Row> strata_in_float(int low, int high, const Settings& settings, Random& random) {
    Worst worst;
    double px = 0.0;
    for (const int m : orders(settings, low, high)) {
        const filter::BsplineTable table(m);
        const double placed = m <= filter::kMaxTableOrder ? filter::kTableError : 0x1p-25 * m;
        const double bound = placed + 3 * 0x1p-24 * largest_ratio(m);
        px = std::max(px, bound);
        for (const std::uint32_t i : {0u, 1u, 7u, 31u, 32u, 62u, 63u}) {
            for (const std::uint32_t word : {0u, 1u, 0x7FFFFFFFu, 0xFFFFFFFFu, static_cast<std::uint32_t>(random())}) {
                if (settings.cancelled()) return {};
                const float q = sample::folded_stratum(i, 64, word);
                const double centred = static_cast<double>(table.centred(q));
                // y and 1 - y exactly: counted from either end in units of 2^-33 / 64.
                const long double below = (i + (word + 0.5L) * 0x1p-32L) / 64;
                const long double above = (63 - i + (~word + 0.5L) * 0x1p-32L) / 64;
                const long double x = centred <= 0.0 ? 0.5L * m + centred : 0.5L * m - centred;
                worst.see(tail_error(m, x, centred <= 0.0 ? below : above) / bound,
                          [&] { return fmt::format("m = {}, stratum {}, word {:#010x}", m, i, word); });
            }
        }
    }
    return {check(fmt::format("strata N = 64 through the float inverse, m = {}..{}", low, high), worst.value() * px, px,
                  "px", worst.where())};
}

// n, N and 1 - N relative to themselves. Every term of the triangle is positive, so a level adds three roundings at
// most (a difference, a product, a sum): (3 m + 5) 2^-53, and no more than the header's contract of 16 eps.
std::vector<Row> tail_values(const Settings& settings, Random& random) {
    Worst density, distribution, survival;
    std::uniform_real_distribution<double> exponent(-3.0, 0.0);
    for (const int m : orders(settings, 1, 100)) {
        const double bound = std::min(16 * kEps, (3 * m + 5) * 0.5 * kEps);
        for (int i = 0; i < settings.trials(12, 4); ++i) {
            if (settings.cancelled()) return {};
            const double x = i == 0 ? 0.5 * m : 0.5 * m * std::pow(10.0, exponent(random));
            const oracle::ExactSpline exact = exact_spline(m, x);
            const auto see = [&](Worst& worst, double found, long double expected, double at) {
                if (expected < static_cast<long double>(std::numeric_limits<double>::min())) return;
                worst.see(static_cast<double>(std::abs(found / expected - 1)) / bound,
                          [&] { return fmt::format("m = {}, x = {:.17g}", m, at); });
            };
            see(density, filter::bspline_pdf(m, x), m == 1 && x >= 1.0 ? 1.0L : exact.pdf, x);
            see(distribution, filter::bspline_cdf(m, x), exact.cdf, x);
            const double mirrored = m - x;  // exact only where m - mirrored gives x back
            if (m - mirrored == x) see(survival, filter::bspline_survival(m, mirrored), exact.cdf, mirrored);
        }
    }
    const double bound = 16 * kEps;
    const auto row = [&](const char* name, const Worst& worst) {
        return check(name, worst.value() * bound, bound, "relative", worst.where());
    };
    return {row("n_m in the tails, m = 1..100", density), row("N_m in the lower tail, m = 1..100", distribution),
            row("1 - N_m in the upper tail, m = 1..100", survival)};
}

// Each of two neighbours errs by a bound at most, so no step back is longer than two.
std::vector<Row> monotonicity(const Settings& settings, Random& random) {
    Worst in_double, in_float, strict;
    for (const int m : orders(settings, 1, 100)) {
        const double bound = 2 * inverse_bound(m);
        std::vector<double> ys;
        std::uniform_real_distribution<double> exponent(-300.0, -0.3);
        for (int i = 0; i < settings.trials(40, 10); ++i) {
            const double y = std::pow(10.0, exponent(random));
            ys.insert(ys.end(), {y, std::nextafter(y, 1.0), 1.0 - y, std::nextafter(1.0 - y, 0.0)});
        }
        std::sort(ys.begin(), ys.end());
        double before = 0.0, y_before = 0.0;
        for (const double y : ys) {
            const double x = filter::bspline_inverse_cdf(m, y);
            in_double.see((before - x) / bound, [&] { return fmt::format("m = {}, y = {:.17g}", m, y); });
            if (y > 1.01 * y_before && y < 0.5)
                strict.see(x > before ? 0.0 : 1.0, [&] { return fmt::format("m = {}, y = {:.17g}", m, y); });
            before = x;
            y_before = y;
        }
        if (m > filter::kMaxTableOrder) continue;
        // Floats around every border of the table's cells, an eighth of an octave each.
        const filter::BsplineTable table(m);
        for (float border = 0x1p-36f; border <= 0.5f; border += 0.125f * std::exp2(std::floor(std::log2(border)))) {
            const float below = table.centred(std::nextafter(border, 0.0f)), at = table.centred(border);
            in_float.see(static_cast<double>(at - below), [&] { return fmt::format("m = {}, q = {:.9g}", m, border); });
        }
    }
    const double px = 2 * inverse_bound(100);
    return {check("inverse in double: longest step back between neighbours", std::max(0.0, in_double.value()) * px, px,
                  "px", in_double.where()),
            check("inverse in double: pairs 1 % apart out of order", std::max(0.0, strict.value()), 0.0, "count",
                  strict.where()),
            check("inverse in float: longest step back at a cell's border", std::max(0.0, in_float.value()),
                  2 * filter::kTableError, "px", in_float.where())};
}

// x(p) + x(1 - p) = m and N(x) + S(x) = 1: m - x and 1 - N are single roundings, since 1 - p is exact for multiples of
// 2^-53; n(x) and n(m - x) are the same sum where m - x is exact.
std::vector<Row> symmetry(const Settings& settings, Random& random) {
    Worst inverse, sum, density;
    for (const int m : orders(settings, 1, 100)) {
        for (int i = 0; i < settings.trials(60, 12); ++i) {
            const double p = static_cast<double>(random() >> (12 + random() % 40)) * 0x1p-53;
            if (!(p > 0.0 && p < 0.5)) continue;
            const double x = filter::bspline_inverse_cdf(m, p), mirrored = filter::bspline_inverse_cdf(m, 1.0 - p);
            const auto where = [&] { return fmt::format("m = {}, p = {:.17g}", m, p); };
            inverse.see(std::abs(mirrored - (m - x)), where);
            sum.see(std::abs(filter::bspline_cdf(m, x) + filter::bspline_survival(m, x) - 1.0), where);
            const double dyadic = std::ldexp(std::ceil(std::ldexp(x, 40)), -40);  // not 0: n_1 is 1 there, 0 at 1
            density.see(std::abs(filter::bspline_pdf(m, dyadic) - filter::bspline_pdf(m, m - dyadic)), where);
        }
    }
    return {check("symmetry: x(1 - p) against m - x(p)", inverse, 0.0, "px"),
            check("symmetry: N + (1 - N) against 1", sum, kEps, ""),
            check("symmetry: n(m - x) against n(x)", density, 0.0, "1/px")};
}

// NaN gives NaN; what lies outside maps to the end of the support next to it; the float table, which promises the
// centre for NaN, never gives anything that is not in the support.
std::vector<Row> not_a_number(const Settings& settings, Random&) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    Worst wrong;
    for (const int m : orders(settings, 1, 100)) {
        const auto expect = [&](bool right, const char* what) {
            wrong.see(right ? 0.0 : 1.0, [&] { return fmt::format("m = {}: {}", m, what); });
        };
        expect(std::isnan(filter::bspline_pdf(m, nan)) && std::isnan(filter::bspline_cdf(m, nan)) &&
                   std::isnan(filter::bspline_survival(m, nan)) && std::isnan(filter::bspline_inverse_cdf(m, nan)),
               "NaN");
        expect(filter::bspline_inverse_cdf(m, 0.0) == 0.0 && filter::bspline_inverse_cdf(m, 1.0) == m, "y = 0 or 1");
        expect(filter::bspline_inverse_cdf(m, -infinity) == 0.0 && filter::bspline_inverse_cdf(m, infinity) == m,
               "infinite y");
        expect(filter::bspline_cdf(m, -infinity) == 0.0 && filter::bspline_cdf(m, infinity) == 1.0 &&
                   filter::bspline_pdf(m, infinity) == 0.0 && filter::bspline_pdf(m, -1e-300) == 0.0,
               "infinite x");
        const filter::BsplineTable table(m);
        for (const float q : {0.0f, -0.0f, 0.5f, -0.5f, 1e-45f, -1e-45f, static_cast<float>(nan), 3.0f}) {
            const float x = table.centred(q);
            expect(std::abs(x) <= 0.5f * static_cast<float>(m), "the float table leaves the support");
        }
    }
    return {check("NaN, infinities, y = 0 and 1: wrong answers", wrong, 0.0, "count")};
}

}  // namespace

void add_bspline_cases(std::vector<Case>& cases) {
    const std::string group = "bspline";
    for (const std::array orders : {std::array{76, 100}, std::array{33, 75}, std::array{9, 32}, std::array{1, 8}}) {
        const int low = orders[0], high = orders[1];
        cases.push_back({group, fmt::format("inverse in double, m = {}..{}", low, high),
                         [=](const Settings& s, Random& r) { return inverse_in_double(low, high, s, r); }});
        cases.push_back({group, fmt::format("strata, m = {}..{}", low, high),
                         [=](const Settings& s, Random& r) { return strata_in_float(low, high, s, r); }});
    }
    cases.push_back({group, "tails", tail_values});
    cases.push_back({group, "monotonicity", monotonicity});
    cases.push_back({group, "symmetry", symmetry});
    cases.push_back({group, "NaN", not_a_number});
}

}  // namespace strata::tools::stability
