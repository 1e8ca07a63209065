// Curves by cubic pieces (hermite.h) as those of curves-inl.h, once straight on and once repeated without end. Include
// after hwy/highway.h.
#if defined(STRATA_NOISE_RELIEF_HERMITE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_HERMITE_INL_H_
#undef STRATA_NOISE_RELIEF_HERMITE_INL_H_
#else
#define STRATA_NOISE_RELIEF_HERMITE_INL_H_
#endif

#include <limits>
#include <utility>

#include "noise/relief/curves-inl.h"
#include "noise/relief/hermite.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

struct HermiteCurve {
    static constexpr bool kHasSpan = true;

    const HermiteTable& table;

    template <class V>
    HWY_INLINE V value_unit(V) const {
        return fixed<V>(table.value_unit);
    }
    template <class V>
    HWY_INLINE V slope_unit(V) const {
        return fixed<V>(table.slope_unit);
    }

    template <class V>
    HWY_INLINE V value(V v) const {
        const Piece<V> p = piece(v);
        const V t = (v - p.x) * p.per_width;
        return p.y + t * (p.c1 + t * (p.c2 + t * p.c3));
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        const Piece<V> p = piece(v);
        const V t = (v - p.x) * p.per_width;
        return p.per_width * (p.c1 + t * (fixed<V>(2.0) * p.c2 + fixed<V>(3.0) * t * p.c3));
    }
    template <class V>
    HWY_INLINE V bend_up(V lo, V hi) const {
        return bend(lo, hi, 1.0);
    }
    template <class V>
    HWY_INLINE V bend_down(V lo, V hi) const {
        return bend(lo, hi, -1.0);
    }
    // Its highest and lowest points are at the interval's ends or knots.
    template <class V>
    HWY_INLINE Span<V> span(V lo, V hi) const {
        const V a = value(lo), b = value(hi);
        Span<V> all{least(a, b), greatest(a, b)};
        for (std::size_t i = 1; i < table.pieces; ++i) {
            const V x = fixed<V>(table.x[i]), y = fixed<V>(table.y[i]);
            all.low = least(all.low, pick(lo < x, pick(x < hi, y, all.low), all.low));
            all.high = greatest(all.high, pick(lo < x, pick(x < hi, y, all.high), all.high));
        }
        return all;
    }
    std::pair<double, double> range(double lo, double hi) const {
        const Span<double> all = span(lo, hi);
        return {all.low, all.high};
    }
    // The slope is quadratic on a piece: steepest at its ends or in between, where the second derivative vanishes.
    double steepest(double lo, double hi) const {
        double most = std::max(std::abs(slope(lo)), std::abs(slope(hi)));
        for (std::size_t i = 1; i < table.pieces; ++i) {
            if (table.x[i] > lo && table.x[i] < hi) most = std::max(most, std::abs(slope(table.x[i])));
            if (table.c3[i] == 0.0) continue;
            const double t = -table.c2[i] / (3.0 * table.c3[i]), at = table.x[i] + t / table.per_width[i];
            if (t > 0.0 && t < 1.0 && at > lo && at < hi) most = std::max(most, std::abs(slope(at)));
        }
        return most;
    }

  private:
    template <class V>
    struct Piece {
        V x, per_width, y, c1, c2, c3;
    };

    template <class V>
    HWY_INLINE Piece<V> piece_at(std::size_t i) const {
        return {fixed<V>(table.x[i]),  fixed<V>(table.per_width[i]), fixed<V>(table.y[i]),
                fixed<V>(table.c1[i]), fixed<V>(table.c2[i]),        fixed<V>(table.c3[i])};
    }
    template <class V>
    HWY_INLINE Piece<V> piece(V v) const {
        Piece<V> p = piece_at<V>(0);
        for (std::size_t i = 1; i < table.pieces; ++i) {
            const Piece<V> next = piece_at<V>(i);
            const auto before = v < next.x;
            p = {pick(before, p.x, next.x),   pick(before, p.per_width, next.per_width),
                 pick(before, p.y, next.y),   pick(before, p.c1, next.c1),
                 pick(before, p.c2, next.c2), pick(before, p.c3, next.c3)};
        }
        return p;
    }

    // The largest of sign times the second derivative, which is linear on a piece, over the parts of pieces within the
    // interval; and at least 0, as on the straight ones.
    template <class V>
    HWY_INLINE V bend(V lo, V hi, double sign) const {
        const V zero = fixed<V>(0.0), one = fixed<V>(1.0), margin = fixed<V>(0x1p-20);
        const V from = lo - margin * size(lo), to = hi + margin * size(hi);
        V most = zero;
        for (std::size_t i = 1; i + 1 < table.pieces; ++i) {
            const double scale = sign * table.per_width[i] * table.per_width[i];
            const V begin = fixed<V>(table.x[i]), end = fixed<V>(table.x[i + 1]), per = fixed<V>(table.per_width[i]);
            const V start = fixed<V>(2.0 * scale * table.c2[i]), rise = fixed<V>(6.0 * scale * table.c3[i]);
            const V t0 = least(greatest((from - begin) * per, zero), one);
            const V t1 = least(greatest((to - begin) * per, zero), one);
            const V here = greatest(start + t0 * rise, start + t1 * rise);
            most = pick(from < end, pick(begin < to, greatest(most, here), most), most);
        }
        return most;
    }
};

// The curve on [0, 1) repeated: g(v) = table(v - floor(v)). The table's knots go from 0 to 1, with equal values and
// slopes there.
struct PeriodicCurve {
    static constexpr bool kHasSpan = true;

    HermiteCurve once;

    template <class V>
    HWY_INLINE V value_unit(V v) const {
        return once.value_unit(v);
    }
    template <class V>
    HWY_INLINE V slope_unit(V v) const {
        return once.slope_unit(v);
    }
    template <class V>
    HWY_INLINE V value(V v) const {
        return once.value(v - whole(v));
    }
    template <class V>
    HWY_INLINE V slope(V v) const {
        return once.slope(v - whole(v));
    }
    template <class V>
    HWY_INLINE V bend_up(V lo, V hi) const {
        return twice(lo, hi, [&](V a, V b) HWY_ATTR { return once.bend_up(a, b); });
    }
    template <class V>
    HWY_INLINE V bend_down(V lo, V hi) const {
        return twice(lo, hi, [&](V a, V b) HWY_ATTR { return once.bend_down(a, b); });
    }
    template <class V>
    HWY_INLINE Span<V> span(V lo, V hi) const {
        const auto low = [&](V a, V b) HWY_ATTR { return fixed<V>(0.0) - once.span(a, b).low; };
        const auto high = [&](V a, V b) HWY_ATTR { return once.span(a, b).high; };
        return {fixed<V>(0.0) - twice(lo, hi, low), twice(lo, hi, high)};
    }
    std::pair<double, double> range(double lo, double hi) const {
        if (!(hi - lo < 1.0)) return once.range(0.0, 1.0);
        const Span<double> all = span(lo, hi);
        return {all.low, all.high};
    }
    double steepest(double lo, double hi) const {
        if (!(hi - lo < 1.0)) return once.steepest(0.0, 1.0);
        return twice(lo, hi, [&](double a, double b) { return once.steepest(a, b); });
    }

  private:
    // The larger of what is asked on the two parts of [lo, hi], which lie in two neighbouring repetitions at most
    // unless the interval is a whole one.
    template <class V, class Ask>
    HWY_INLINE V twice(V lo, V hi, const Ask& ask) const {
        const V zero = fixed<V>(0.0), one = fixed<V>(1.0), from = whole(lo);
        const auto is_short = hi - lo < one;
        const V begin = pick(is_short, lo - from, zero), end = pick(is_short, hi - from, one);
        const V first = ask(begin, least(end, one));
        return pick(one < end, greatest(first, ask(zero, least(greatest(end - one, zero), one))), first);
    }
};

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
