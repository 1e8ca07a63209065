// Curves g that heights go through, as in g(r(x)), written once for doubles and for vectors of floats. Include after
// hwy/highway.h.
//
// Every curve is continuously differentiable and its slope is Lipschitz. It gives
//   value(v), slope(v)      g and g'
//   bend_up(lo, hi)         at least the largest g'' on [lo, hi], and at least 0
//   bend_down(lo, hi)       at least the largest -g'' on [lo, hi], and at least 0
//   range(lo, hi)           the least and the largest g on [lo, hi]
//   steepest(lo, hi)        the largest |g'| on [lo, hi]
// and may give
//   span(lo, hi)            the least and the largest g, of any numbers (kHasSpan): bounds over large balls
//   kLow, kHigh             between which g stays wherever it is asked for
//   kRises                  g' is nowhere below 0
//   value_unit(v), slope_unit(v)   what the roundings of g and g' are in proportion to, where that is more than
//                           1 + |g| and 1 + |g'|
// Bounds are those of exact arithmetic; rounding comes on top (src/trace/enclosure_rules-inl.h).
#if defined(STRATA_NOISE_RELIEF_CURVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_CURVES_INL_H_
#undef STRATA_NOISE_RELIEF_CURVES_INL_H_
#else
#define STRATA_NOISE_RELIEF_CURVES_INL_H_
#endif

#include <utility>

#include "noise/relief/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

// The least and the largest of something.
template <class V>
struct Span {
    V low, high;
};

// (1 - sqrt(v^2 + e^2))^2, v in [-1, 1]: a crest along v = 0 with a top of curvature 1/e, flat valleys at |v| = 1.
// With r = sqrt(v^2 + e^2): g' = 2 v - 2 v / r and g'' = 2 - 2 e^2 / r^3, which rises with |v| from 2 - 2 / e < 0.
struct RidgeCurve {
    static constexpr double kLow = 0.0, kHigh = 1.0;

    double roundness;  // e, in (0, 1)

    template <class V>
    HWY_INLINE V radius(V v) const {
        return root(v * v + fixed<V>(roundness * roundness));
    }
    template <class V>
    HWY_INLINE V value(V v) const {
        const V below = fixed<V>(1.0) - radius(v);
        return below * below;
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        return fixed<V>(2.0) * v - fixed<V>(2.0) * v / radius(v);
    }
    template <class V>
    HWY_INLINE V second(V r) const {
        return fixed<V>(2.0) - fixed<V>(2.0 * roundness * roundness) / (r * r * r);
    }
    template <class V>
    HWY_INLINE V bend_up(V, V) const {
        return fixed<V>(2.0);  // A crest has less, which is not worth the root and the division.
    }
    template <class V>
    HWY_INLINE V bend_down(V lo, V hi) const {
        const V nearest = greatest(greatest(lo, fixed<V>(0.0) - hi), fixed<V>(0.0));  // the least |v|
        return greatest(fixed<V>(0.0) - second(radius(nearest)), fixed<V>(0.0));
    }
    // Falls with |v| until r = 1.
    std::pair<double, double> range(double lo, double hi) const {
        const double nearest = std::max({lo, -hi, 0.0}), farthest = std::max(std::abs(lo), std::abs(hi));
        const bool reaches_valley = radius(nearest) <= 1.0 && radius(farthest) >= 1.0;
        const double a = value(nearest), b = value(farthest);
        return {reaches_valley ? 0.0 : std::min(a, b), std::max(a, b)};
    }
    // |g'| = 2 |v| |1 - 1/r| is largest where g'' = 0, r^3 = e^2, or at an end.
    double steepest(double lo, double hi) const {
        const double turn_r = std::cbrt(roundness * roundness);
        const double turn = std::sqrt(std::max(turn_r * turn_r - roundness * roundness, 0.0));
        return std::max({std::abs(slope(lo)), std::abs(slope(hi)), std::abs(slope(turn))});
    }
};

// u - u^2/4 up to 2, then 1, with u = scale v: a clip at 1 without a kink, for weights v >= 0.
struct SoftClip {
    static constexpr double kLow = 0.0, kHigh = 1.0;
    static constexpr bool kRises = true;

    double scale = 1.0;

    template <class V>
    HWY_INLINE V clipped(V v) const {
        return least(fixed<V>(scale) * v, fixed<V>(2.0));
    }
    template <class V>
    HWY_INLINE V value(V v) const {
        const V u = clipped(v);
        return u - fixed<V>(0.25) * u * u;
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        return fixed<V>(scale) - fixed<V>(0.5 * scale) * clipped(v);
    }
    template <class V>
    HWY_INLINE V slope_unit(V) const {
        return fixed<V>(scale);
    }
    template <class V>
    HWY_INLINE V bend_up(V, V) const {
        return fixed<V>(0.0);
    }
    template <class V>
    HWY_INLINE V bend_down(V lo, V) const {
        return pick(lo < fixed<V>(2.0 / scale), fixed<V>(0.5 * scale * scale), fixed<V>(0.0));
    }
    std::pair<double, double> range(double lo, double hi) const { return {value(lo), value(hi)}; }
    double steepest(double lo, double hi) const { return std::max(std::abs(slope(lo)), std::abs(slope(hi))); }
};

// f + (d + sqrt(d^2 + s^2)) / 2 with d = v - f: what lies deeper than the floor f is filled up to it, softly over s.
// g' rises from 0 to 1, g'' = s^2 / (2 (d^2 + s^2)^(3/2)) is largest at the floor.
struct FillCurve {
    double floor, softness;

    // v - f is off by the roundings of both.
    template <class V>
    HWY_INLINE V value_unit(V v) const {
        return fixed<V>(std::abs(floor)) + size(v);
    }
    template <class V>
    HWY_INLINE V slope_unit(V v) const {
        return fixed<V>(1.0 / softness) * (fixed<V>(std::abs(floor)) + size(v));
    }

    template <class V>
    HWY_INLINE V distance(V v) const {
        const V d = v - fixed<V>(floor);
        return root(d * d + fixed<V>(softness * softness));
    }
    template <class V>
    HWY_INLINE V value(V v) const {
        return fixed<V>(floor) + fixed<V>(0.5) * (v - fixed<V>(floor) + distance(v));
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        return fixed<V>(0.5) + fixed<V>(0.5) * (v - fixed<V>(floor)) / distance(v);
    }
    template <class V>
    HWY_INLINE V bend_up(V lo, V hi) const {
        const V f = fixed<V>(floor);
        const V nearest = f + greatest(greatest(lo - f, f - hi), fixed<V>(0.0));
        const V r = distance(nearest);
        return fixed<V>(0.5 * softness * softness) / (r * r * r);
    }
    template <class V>
    HWY_INLINE V bend_down(V, V) const {
        return fixed<V>(0.0);
    }
    std::pair<double, double> range(double lo, double hi) const { return {value(lo), value(hi)}; }
    double steepest(double, double hi) const { return slope(hi); }
};

// m (sqrt(v^2 + e^2) - e): |v| with a rounded valley. With r = sqrt(v^2 + e^2), g' = m v / r, and g'' = m e^2 / r^3 is
// largest where |v| is least.
struct BillowCurve {
    double roundness, scale;  // e and m, above 0

    template <class V>
    HWY_INLINE V radius(V v) const {
        return root(v * v + fixed<V>(roundness * roundness));
    }
    template <class V>
    HWY_INLINE V value(V v) const {
        return fixed<V>(scale) * (radius(v) - fixed<V>(roundness));
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        return fixed<V>(scale) * v / radius(v);
    }
    template <class V>
    HWY_INLINE V bend_up(V lo, V hi) const {
        const V r = radius(greatest(greatest(lo, fixed<V>(0.0) - hi), fixed<V>(0.0)));
        return fixed<V>(scale * roundness * roundness) / (r * r * r);
    }
    template <class V>
    HWY_INLINE V bend_down(V, V) const {
        return fixed<V>(0.0);
    }
    std::pair<double, double> range(double lo, double hi) const {
        return {value(std::max({lo, -hi, 0.0})), value(std::max(std::abs(lo), std::abs(hi)))};
    }
    double steepest(double lo, double hi) const { return slope(std::max(std::abs(lo), std::abs(hi))); }
};

// (1 + v)^2 / 4 of v in [-1, 1]: what multiplies finer octaves, 0 in the deepest places and 1 on the highest.
struct LiftCurve {
    static constexpr double kLow = 0.0, kHigh = 1.0;
    static constexpr bool kRises = true;

    template <class V>
    HWY_INLINE V value(V v) const {
        const V above = fixed<V>(0.5) + fixed<V>(0.5) * v;
        return above * above;
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        return fixed<V>(0.5) + fixed<V>(0.5) * v;
    }
    template <class V>
    HWY_INLINE V bend_up(V, V) const {
        return fixed<V>(0.5);
    }
    template <class V>
    HWY_INLINE V bend_down(V, V) const {
        return fixed<V>(0.0);
    }
    std::pair<double, double> range(double lo, double hi) const { return {value(lo), value(hi)}; }
    double steepest(double, double hi) const { return slope(hi); }
};

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
