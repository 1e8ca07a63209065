// What is known of reliefs around a vector of points: values with bounds in a ball. Include after hwy/foreach_target.h
// and hwy/highway.h, with STRATA_RELIEF_FORMULAS defined.
//
// Around a point p, for every displacement D with |D| <= radius (over 2-D noise: of its horizontal part),
//
//   r(p + D) <= value + gradient . D + up(|D|),    r(p + D) >= value + gradient . D - down(|D|),
//
// where up and down are e0 + e1 |D| + e2 |D|^2 with coefficients no less than 0. This form is kept by sums, products,
// curves and displacements of the domain (enclosure_rules-inl.h, relief_lanes-inl.h). What float arithmetic adds to
// value and gradient is part of e0 and e1; the slacks' own roundings are made good by every operation, in rounded().
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

// Slacks are sums of products of numbers no less than 0. In an operation such a product is rounded fewer than 48 times
// in a row, by 2^-24 of itself at most, and multiplied by this.
inline constexpr float kRoundingsOfSlack = 1.0f + 0x1p-18f;

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
HWY_INLINE Slack mul_add(const Slack& a, FloatVec by, const Slack& b) {
    return {hn::MulAdd(a.e0, by, b.e0), hn::MulAdd(a.e1, by, b.e1), hn::MulAdd(a.e2, by, b.e2)};
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

// Bounds beyond it are of no use, and their products would soon be no numbers at all: nothing is believed any more of a
// lane in which an operation that multiplies slacks had such a result. Between two of these, sums and constant factors
// (1e10 at most) keep them finite.
inline constexpr float kMostSlack = 1e12f;

// Notes the lanes of `used` in which x is of no use. Sums, for a maximum may hide what is not a number.
HWY_INLINE void check(const Enclosure& x, const ReliefPoints& points, hn::Mask<FloatTag> used) {
    const FloatVec ups = hn::Add(hn::Add(x.up.e0, x.up.e1), x.up.e2);
    const FloatVec downs = hn::Add(hn::Add(x.down.e0, x.down.e1), x.down.e2);
    const auto fits = hn::Lt(hn::Add(ups, downs), set(kMostSlack));
    *points.broken = hn::Or(*points.broken, hn::AndNot(fits, used));
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
