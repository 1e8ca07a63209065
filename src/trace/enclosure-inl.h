// What is known of reliefs around a vector of points: values with bounds in a ball. Include after hwy/foreach_target.h
// and hwy/highway.h, with STRATA_RELIEF_FORMULAS defined.
//
// Around a point p, for every displacement D with |D| <= radius (over 2-D noise: of its horizontal part),
//
//   r(p + D) <= value + gradient . D + up(|D|),    r(p + D) >= value + gradient . D - down(|D|),
//
// where up and down are e0 + e1 |D| + e2 |D|^2 with coefficients no less than 0. This form is kept by sums, products,
// curves and displacements of the domain (enclosure_rules-inl.h, relief_lanes-inl.h). What float arithmetic adds to
// value and gradient is part of e0 and e1; the slacks' own roundings are made good once, by inflated().
#if defined(STRATA_TRACE_ENCLOSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_ENCLOSURE_INL_H_
#undef STRATA_TRACE_ENCLOSURE_INL_H_
#else
#define STRATA_TRACE_ENCLOSURE_INL_H_
#endif

#include "noise/relief/numbers-inl.h"
#include "src/trace/base-inl.h"
#include "src/trace/ray.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// A vector of floats as the number that curves are written with.
struct Lanes {
    FloatVec v;
};

HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return {hn::Add(a.v, b.v)}; }
HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return {hn::Sub(a.v, b.v)}; }
HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return {hn::Mul(a.v, b.v)}; }
HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return {hn::Div(a.v, b.v)}; }
HWY_INLINE hn::Mask<FloatTag> operator<(Lanes a, Lanes b) { return hn::Lt(a.v, b.v); }
HWY_INLINE Lanes least(Lanes a, Lanes b) { return {hn::Min(a.v, b.v)}; }
HWY_INLINE Lanes greatest(Lanes a, Lanes b) { return {hn::Max(a.v, b.v)}; }
HWY_INLINE Lanes root(Lanes a) { return {hn::Sqrt(a.v)}; }
HWY_INLINE Lanes size(Lanes a) { return {hn::Abs(a.v)}; }
HWY_INLINE Lanes whole(Lanes a) { return {hn::Floor(a.v)}; }
HWY_INLINE Lanes pick(hn::Mask<FloatTag> condition, Lanes yes, Lanes no) {
    return {hn::IfThenElse(condition, yes.v, no.v)};
}

}  // namespace strata::trace::HWY_NAMESPACE

namespace strata::noise::HWY_NAMESPACE {

template <>
struct Fixed<trace::HWY_NAMESPACE::Lanes> {
    static HWY_INLINE trace::HWY_NAMESPACE::Lanes of(double x) { return {hn::Set(FloatTag(), static_cast<float>(x))}; }
};

}  // namespace strata::noise::HWY_NAMESPACE

namespace strata::trace::HWY_NAMESPACE {

// Rounding to nearest is off by 2^-24 of the result. Each operation here rounds a value at most four times and each
// component of a gradient four times.
inline constexpr float kOperation = 0x1p-22f;

// Curves are evaluated by at most eight roundings, of values no larger than a few times the larger of 1 and the result.
inline constexpr float kCurveError = 0x1p-20f;

HWY_INLINE FloatVec set(float x) { return hn::Set(FloatTag(), x); }
HWY_INLINE FloatVec set(double x) { return hn::Set(FloatTag(), static_cast<float>(x)); }

// e0 + e1 d + e2 d^2 at a distance d.
struct Slack {
    FloatVec e0, e1, e2;

    HWY_INLINE FloatVec at(FloatVec distance) const { return hn::MulAdd(hn::MulAdd(e2, distance, e1), distance, e0); }
};

HWY_INLINE Slack no_slack() {
    const FloatVec zero = hn::Zero(FloatTag());
    return {zero, zero, zero};
}
HWY_INLINE Slack plus(const Slack& a, const Slack& b) {
    return {hn::Add(a.e0, b.e0), hn::Add(a.e1, b.e1), hn::Add(a.e2, b.e2)};
}
HWY_INLINE Slack times(const Slack& a, FloatVec by) {
    return {hn::Mul(a.e0, by), hn::Mul(a.e1, by), hn::Mul(a.e2, by)};
}
HWY_INLINE Slack larger(const Slack& a, const Slack& b) {
    return {hn::Max(a.e0, b.e0), hn::Max(a.e1, b.e1), hn::Max(a.e2, b.e2)};
}
HWY_INLINE Slack choose(hn::Mask<FloatTag> condition, const Slack& yes, const Slack& no) {
    return {hn::IfThenElse(condition, yes.e0, no.e0), hn::IfThenElse(condition, yes.e1, no.e1),
            hn::IfThenElse(condition, yes.e2, no.e2)};
}

// A relief, or a part of one, around a vector of points.
struct Enclosure {
    FloatVec value;
    FloatPoint gradient;
    Slack up, down;
};

HWY_INLINE FloatVec length(const FloatPoint& a) { return hn::Sqrt(dot(a, a)); }
HWY_INLINE FloatPoint scaled(const FloatPoint& a, FloatVec by) {
    return {hn::Mul(a.x, by), hn::Mul(a.y, by), hn::Mul(a.z, by)};
}
HWY_INLINE FloatPoint mul_add(FloatVec by, const FloatPoint& a, const FloatPoint& b) {
    return {hn::MulAdd(by, a.x, b.x), hn::MulAdd(by, a.y, b.y), hn::MulAdd(by, a.z, b.z)};
}

HWY_INLINE void widen(Enclosure& x, FloatVec e0, FloatVec e1) {
    x.up.e0 = hn::Add(x.up.e0, e0);
    x.down.e0 = hn::Add(x.down.e0, e0);
    x.up.e1 = hn::Add(x.up.e1, e1);
    x.down.e1 = hn::Add(x.down.e1, e1);
}

// What the points of a call share, a lane each.
struct ReliefPoints {
    FloatVec radius;             // of the ball in which the bounds hold
    hn::Mask<FloatTag> active;   // the lanes that are asked for
    hn::Mask<FloatTag> whole;    // those in which no octave is left out
    TraceCounters* counters;     // noise evaluations and lanes are added
    FloatVec* evaluations;       // of each lane, added to
    hn::Mask<FloatTag>* broken;  // lanes in which bounds grew past kMostSlack are added
};

// Bounds beyond it are of no use, and their products would soon be no numbers at all.
inline constexpr float kMostSlack = 1e12f;

// With what an operation's rounding adds.
HWY_INLINE Enclosure rounded(Enclosure x, const ReliefPoints& points, hn::Mask<FloatTag> used) {
    const FloatVec unit = set(kOperation);
    const FloatVec e0 = hn::Mul(unit, hn::Abs(x.value));
    const FloatVec sum = hn::Add(hn::Abs(x.gradient.x), hn::Add(hn::Abs(x.gradient.y), hn::Abs(x.gradient.z)));
    widen(x, e0, hn::Mul(unit, sum));
    const FloatVec most = set(kMostSlack);
    const Slack wide = larger(x.up, x.down);
    // Sums, for a maximum may hide what is not a number.
    const FloatVec size = hn::Add(hn::Add(wide.e0, wide.e2), hn::Add(hn::Add(wide.e1, sum), hn::Abs(x.value)));
    const auto fits = hn::Lt(size, most);
    *points.broken = hn::Or(*points.broken, hn::AndNot(fits, used));
    const auto least = [&](const Slack& a) HWY_ATTR {
        return Slack{hn::Min(a.e0, most), hn::Min(a.e1, most), hn::Min(a.e2, most)};
    };
    x.up = least(x.up);
    x.down = least(x.down);
    x.gradient = {hn::Clamp(x.gradient.x, hn::Neg(most), most), hn::Clamp(x.gradient.y, hn::Neg(most), most),
                  hn::Clamp(x.gradient.z, hn::Neg(most), most)};
    return x;
}

// Sums of products of numbers no less than 0, each rounded a few hundred times at most.
HWY_INLINE Slack inflated(const Slack& slack) { return times(slack, set(1.0f + 0x1p-14f)); }

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
