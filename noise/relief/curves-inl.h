// Curves g that heights go through, as in g(r(x)), written once for doubles and for vectors of floats. Include after
// hwy/highway.h.
//
// Every curve is continuously differentiable and its slope is Lipschitz. It gives
//   value(v), slope(v)      g and g'
//   bend_up(lo, hi)         at least the largest g'' on [lo, hi], and at least 0
//   bend_down(lo, hi)       at least the largest -g'' on [lo, hi], and at least 0
//   range(lo, hi)           the least and the largest g on [lo, hi]
//   steepest(lo, hi)        the largest |g'| on [lo, hi]
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

// (1 - sqrt(v^2 + e^2))^2, v in [-1, 1]: a crest along v = 0 with a top of curvature 1/e, flat valleys at |v| = 1.
// With r = sqrt(v^2 + e^2): g' = 2 v - 2 v / r and g'' = 2 - 2 e^2 / r^3, which rises with |v| from 2 - 2 / e < 0.
struct RidgeCurve {
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
    HWY_INLINE V bend_up(V lo, V hi) const {
        return greatest(second(radius(greatest(size(lo), size(hi)))), fixed<V>(0.0));
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

// u - u^2/4 up to 2, then 1: a clip at 1 without a kink, for weights u >= 0.
struct SoftClip {
    template <class V>
    HWY_INLINE V value(V u) const {
        const V below = least(u, fixed<V>(2.0));
        return below - fixed<V>(0.25) * below * below;
    }
    template <class V>
    HWY_INLINE V slope(V u) const {
        return fixed<V>(1.0) - fixed<V>(0.5) * least(u, fixed<V>(2.0));
    }
    template <class V>
    HWY_INLINE V bend_up(V, V) const {
        return fixed<V>(0.0);
    }
    template <class V>
    HWY_INLINE V bend_down(V lo, V) const {
        return pick(lo < fixed<V>(2.0), fixed<V>(0.5), fixed<V>(0.0));
    }
    std::pair<double, double> range(double lo, double hi) const { return {value(lo), value(hi)}; }
    double steepest(double lo, double hi) const { return std::max(std::abs(slope(lo)), std::abs(slope(hi))); }
};

// f + (d + sqrt(d^2 + s^2)) / 2 with d = v - f: what lies deeper than the floor f is filled up to it, softly over s.
// g' rises from 0 to 1, g'' = s^2 / (2 (d^2 + s^2)^(3/2)) is largest at the floor.
struct FillCurve {
    double floor, softness;

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

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
