// Running error analysis of noise/noise-inl.h: its operations, in its order, on ranges of exact results with bounds of
// what rounding adds. Everything here is in double; its own rounding is covered by the certificate's margin.
//
// Every intermediate is linear in the corners' gradients, and so is a bound of its error: a rounding costs at most e
// times the size of what is rounded, and the size of a sum is at most the sum of the sizes of its corners' parts. So a
// Part is the share of one corner with one gradient, the other corners being zero; the whole error is at most the sum
// of the corners' largest. A fused multiply-add leaves a rounding out and changes nothing else: bounds without it cover
// it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace strata::noise::test {

// A rounding to the nearest float is off by at most e |x|. Errors are in units of e.
inline constexpr double kUnit = 0x1p-24;

struct Range {
    double lo = 0.0, hi = 0.0;

    double size() const { return std::max(std::abs(lo), std::abs(hi)); }
};

inline Range operator+(const Range& a, const Range& b) { return {a.lo + b.lo, a.hi + b.hi}; }
inline Range operator-(const Range& a, const Range& b) { return {a.lo - b.hi, a.hi - b.lo}; }
inline Range operator*(const Range& a, const Range& b) {
    const std::array<double, 4> p = {a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
    return {*std::min_element(p.begin(), p.end()), *std::max_element(p.begin(), p.end())};
}
inline Range operator*(double s, const Range& a) { return Range{s, s} * a; }

// A computed number: exact is where it would be without rounding, error bounds how far it is from there.
struct Part {
    Range exact;
    double error = 0.0;

    double size() const { return exact.size() + kUnit * error; }
};

// Of a rounding of numbers up to `size`, a power of two being exact: half the spacing of floats just below.
inline double rounding(double size) { return size > 0.0 ? std::exp2(std::ceil(std::log2(size)) - 1.0) : 0.0; }

inline Part product(const Part& factor, const Part& x) {
    Part p{factor.exact * x.exact, factor.error * x.exact.size() + factor.size() * x.error};
    p.error += p.size();
    return p;
}

inline Part sum(const Part& a, const Part& b) {
    Part s{a.exact + b.exact, a.error + b.error};
    s.error += s.size();
    return s;
}

inline Part multiply_add(const Part& factor, const Part& x, const Part& addend) {
    return sum(product(factor, x), addend);
}

inline Part twice(const Part& x) { return {2.0 * x.exact, 2.0 * x.error}; }

// How much of an interpolation between whole numbers up to 8 needs no rounding.
enum class Exact { nothing, difference, product };

// b - a, where x is one of them and the other is another corner's.
inline Part difference(const Part& x, bool is_above, Exact exact) {
    Part d{is_above ? x.exact : -1.0 * x.exact, x.error};
    if (exact == Exact::nothing) d.error += d.size();
    return d;
}

// t (b - a) + a, where x is one of them and the other is another corner's; t is the weight as it was computed.
inline Part lerp(const Part& x, bool is_above, const Range& t, Exact exact) {
    const Range weight = is_above ? t : Range{1.0, 1.0} - t;
    Part r{weight * x.exact, weight.size() * x.error};
    const Part d = difference(x, is_above, exact);
    r.error += t.size() * (d.error - x.error);
    if (exact != Exact::product) r.error += t.size() * d.size();
    r.error += r.size();
    return r;
}

// What depends on one coordinate: the offsets from the planes below and above, the fade and its derivatives.
struct AxisModel {
    Part below, above, fade, first, second;

    // The fade as computed.
    Range weight() const { return {fade.exact.lo - kUnit * fade.error, fade.exact.hi + kUnit * fade.error}; }
};

// As noise-inl.h goes, for t in [lo, hi] of [0,1]. A computed |u| <= 1/2 and w = u^2, q <= 1/4, because rounding is
// monotone. kSlack covers what earlier errors, none above 16 e, add to a number that is rounded.
inline constexpr double kSlack = 16 * kUnit;

inline AxisModel axis_model(double lo, double hi) {
    AxisModel m;
    m.below = {{lo, hi}, 0.0};
    m.above = {{lo - 1.0, hi - 1.0}, lo < 0.5 ? 0.5 : 0.0};  // exact from 1/2 on (Sterbenz)
    const Range u{lo - 0.5, hi - 0.5};
    const double u_size = u.size(), u_error = lo < 0.25 ? 0.25 : 0.0;  // exact from 1/4 on
    const double least = u.lo <= 0.0 && u.hi >= 0.0 ? 0.0 : std::min(std::abs(u.lo), std::abs(u.hi));
    const Range w{least * least, u_size * u_size}, q{0.25 - w.hi, 0.25 - w.lo};
    const double of_square = 2.0 * u_size * u_error + kUnit * u_error * u_error;
    const double w_error = of_square + rounding(std::min(w.hi + kSlack, 0.25));

    const double q_error = w_error + rounding(std::min(q.hi + kSlack, 0.25));
    const double q_size = std::min(q.hi + kUnit * q_error, 0.25);

    // 6 q + 2, then q times that + 1, then u times that + 1/2.
    const Range linear{6.0 * q.lo + 2.0, 6.0 * q.hi + 2.0};
    const double linear_error = 6.0 * q_error + rounding(6.0 * q_size) + rounding(linear.size() + kSlack);
    const Range bent = q * linear, poly = {1.0 + bent.lo, 1.0 + bent.hi};
    const double poly_error = q_error * linear.size() + q_size * linear_error + rounding(bent.size() + kSlack) +
                              rounding(poly.size() + kSlack);
    const auto at = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
    m.fade.exact = {at(lo), at(hi)};
    m.fade.error = u_error * (poly.size() + kUnit * poly_error) + u_size * poly_error +
                   rounding((u * poly).size() + kSlack) + rounding(at(hi) + kSlack);

    const double square_error = 2.0 * q.hi * q_error + kUnit * q_error * q_error + rounding(q_size * q_size);
    m.first.exact = {30.0 * q.lo * q.lo, 30.0 * q.hi * q.hi};
    m.first.error = 30.0 * square_error + rounding(30.0 * (q.hi * q.hi + kUnit * square_error));

    const Range uq = u * q;
    const double uq_error = u_error * q_size + u_size * q_error + rounding(uq.size() + kSlack);
    m.second.exact = -120.0 * uq;
    m.second.error = 120.0 * uq_error + rounding(120.0 * (uq.size() + kUnit * uq_error));
    return m;
}

}  // namespace strata::noise::test
