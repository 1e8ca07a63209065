// Curves that rise by steps (curves-inl.h says what each gives). Include after hwy/highway.h.
#if defined(STRATA_NOISE_RELIEF_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_STEPS_INL_H_
#undef STRATA_NOISE_RELIEF_STEPS_INL_H_
#else
#define STRATA_NOISE_RELIEF_STEPS_INL_H_
#endif

#include <utility>

#include "noise/relief/curves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

// 3 t^2 - 2 t^3 of t = v clamped to [0, 1]: 0, then 1. g'' = 6 - 12 t falls within, and is 0 outside.
struct SmoothStep {
    static constexpr bool kHasSpan = true;

    template <class V>
    HWY_INLINE V clamped(V v) const {
        return least(greatest(v, fixed<V>(0.0)), fixed<V>(1.0));
    }
    template <class V>
    HWY_INLINE V value(V v) const {
        const V t = clamped(v);
        return t * t * (fixed<V>(3.0) - fixed<V>(2.0) * t);
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        const V t = clamped(v);
        return fixed<V>(6.0) * t * (fixed<V>(1.0) - t);
    }
    template <class V>
    HWY_INLINE V bend_up(V lo, V hi) const {
        const V zero = fixed<V>(0.0);
        return pick(zero < hi, greatest(fixed<V>(6.0) - fixed<V>(12.0) * greatest(lo, zero), zero), zero);
    }
    template <class V>
    HWY_INLINE V bend_down(V lo, V hi) const {
        const V zero = fixed<V>(0.0), one = fixed<V>(1.0);
        return pick(lo < one, greatest(fixed<V>(12.0) * least(hi, one) - fixed<V>(6.0), zero), zero);
    }
    template <class V>
    HWY_INLINE Span<V> span(V lo, V hi) const {
        return {value(lo), value(hi)};
    }
    std::pair<double, double> range(double lo, double hi) const { return {value(lo), value(hi)}; }
    double steepest(double lo, double hi) const { return lo < 0.5 && hi > 0.5 ? 1.5 : std::max(slope(lo), slope(hi)); }
};

// v + strength step (3 f^2 - 2 f^3 - f), f = v / step - floor(v / step): rises with v. g'' = strength (6 - 12 f) /
// step.
struct TerraceCurve {
    static constexpr bool kHasSpan = true;

    double step, strength;  // in [0, 1]

    template <class V>
    HWY_INLINE V part(V v) const {
        const V steps = v * fixed<V>(1.0 / step);
        return steps - whole(steps);
    }
    // f is off by the roundings of v / step.
    template <class V>
    HWY_INLINE V value_unit(V v) const {
        return fixed<V>(step) + size(v);
    }
    template <class V>
    HWY_INLINE V slope_unit(V v) const {
        return fixed<V>(1.0) + fixed<V>(12.0 / step) * size(v);
    }
    template <class V>
    HWY_INLINE V value(V v) const {
        const V f = part(v);
        return v + fixed<V>(strength * step) * (f * (f * (fixed<V>(3.0) - fixed<V>(2.0) * f) - fixed<V>(1.0)));
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        const V f = part(v);
        return fixed<V>(1.0) + fixed<V>(strength) * (fixed<V>(6.0) * f * (fixed<V>(1.0) - f) - fixed<V>(1.0));
    }
    // Largest just after a step, if there is one within or near, else at lo.
    template <class V>
    HWY_INLINE V bend_up(V lo, V hi) const {
        const V at_lo = fixed<V>(1.0) - fixed<V>(2.0) * part(lo - margin(lo));
        const V most = pick(crosses(lo, hi), fixed<V>(1.0), greatest(at_lo, fixed<V>(0.0)));
        return fixed<V>(6.0 * strength / step) * most;
    }
    template <class V>
    HWY_INLINE V bend_down(V lo, V hi) const {
        const V at_hi = fixed<V>(2.0) * part(hi + margin(hi)) - fixed<V>(1.0);
        const V most = pick(crosses(lo, hi), fixed<V>(1.0), greatest(at_hi, fixed<V>(0.0)));
        return fixed<V>(6.0 * strength / step) * most;
    }
    template <class V>
    HWY_INLINE Span<V> span(V lo, V hi) const {
        return {value(lo), value(hi)};
    }
    std::pair<double, double> range(double lo, double hi) const { return {value(lo), value(hi)}; }
    double steepest(double, double) const { return 1.0 + 0.5 * strength; }

  private:
    template <class V>
    HWY_INLINE V margin(V v) const {
        return fixed<V>(0x1p-20) * (size(v) + fixed<V>(step));
    }
    template <class V>
    HWY_INLINE auto crosses(V lo, V hi) const {
        const V per = fixed<V>(1.0 / step);
        return whole((lo - margin(lo)) * per) < whole((hi + margin(hi)) * per);
    }
};

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
