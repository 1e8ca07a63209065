// Reliefs on a vector of points, each with bounds in a ball around its point. Include after hwy/foreach_target.h and
// hwy/highway.h, with STRATA_RELIEF_FORMULAS defined.
//
// Around a point p, for every displacement D with |D| <= radius (over 2-D noise: of its horizontal part),
//
//   r(p + D) <= value + gradient . D + up(|D|),    r(p + D) >= value + gradient . D - down(|D|),
//
// where up and down are e0 + e1 |D| + e2 |D|^2 with coefficients no less than 0. This form is kept by sums, products,
// curves and displacements of the domain, each of which is one function of LaneNumbers. What float arithmetic adds to
// value and gradient is part of e0 and e1; the slacks' own roundings are made good once, by inflated().
#if defined(STRATA_TRACE_RELIEF_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_RELIEF_LANES_INL_H_
#undef STRATA_TRACE_RELIEF_LANES_INL_H_
#else
#define STRATA_TRACE_RELIEF_LANES_INL_H_
#endif

#include <array>
#include <utility>

#include "noise/float_error.h"
#include "noise/relief/frame.h"
#include "noise/relief/nodes/all.h"
#include "noise/relief/stripe.h"
#include "src/trace/base-inl.h"
#include "src/trace/ray.h"
#include "src/trace/relief_plan.h"
#include "src/trace/stripe-inl.h"

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

// Sines, cosines and their angles (stripe-inl.h).
inline constexpr double kStripeError = 0x1p-19;

// Octaves are evaluated where the ball is smaller than this many of their lattice cells. Speed only.
inline constexpr float kReliefCellsAhead = 0.3f;

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
    const auto fits = hn::Lt(hn::Add(hn::Max(wide.e0, wide.e2), hn::Max(wide.e1, sum)), most);
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

template <bool kPlanar>
class LaneNumbers : public noise::ReliefFrame {
  public:
    using Number = Enclosure;
    using Displacement = std::array<Number, 3>;

    // The point at which a relief is read: `at` + J D + e with |J D + e| <= stretch |D| + slack.e0, |e| <= slack(|D|).
    struct Domain {
        WidePoint at;
        bool is_plain = true;  // J is 1, the slack 0
        std::array<FloatPoint, 3> rows{};
        FloatVec stretch;
        Slack slack;
        double reach;  // bound of |at| on every axis of every lane
    };

    HWY_INLINE LaneNumbers(const ReliefPlan& plan, std::size_t index, const ReliefPoints& points)
        : ReliefFrame(plan.relief->parts()[index], kPlanar ? 2 : 3),
          plan_(plan),
          index_(index),
          points_(points),
          counted_(points.active) {}

    static HWY_INLINE Domain domain(const WidePoint& at, double reach) {
        return {at, true, {}, set(1.0f), no_slack(), reach};
    }

    static HWY_INLINE Number constant(double x) {
        const FloatVec zero = hn::Zero(FloatTag());
        const FloatVec off = set(std::abs(x) * 0x1p-23);
        return {set(x), {zero, zero, zero}, {off, zero, zero}, {off, zero, zero}};
    }
    HWY_INLINE Number plus(const Number& a, const Number& b) const {
        return finished({hn::Add(a.value, b.value),
                         {hn::Add(a.gradient.x, b.gradient.x), hn::Add(a.gradient.y, b.gradient.y),
                          hn::Add(a.gradient.z, b.gradient.z)},
                         HWY_NAMESPACE::plus(a.up, b.up),
                         HWY_NAMESPACE::plus(a.down, b.down)});
    }
    HWY_INLINE Number scaled(const Number& a, double by) const {
        const FloatVec factor = set(by), size = set(std::abs(by));
        const Slack& up = by < 0.0 ? a.down : a.up;
        const Slack& down = by < 0.0 ? a.up : a.down;
        return finished(
            {hn::Mul(a.value, factor), HWY_NAMESPACE::scaled(a.gradient, factor), times(up, size), times(down, size)});
    }

    // With a = v + p and b = w + q, a b = v w + v q + w p + p q; |p| and |q| are each bounded by e0 + k |D|.
    HWY_INLINE Number product(const Number& a, const Number& b) const {
        const FloatVec zero = hn::Zero(FloatTag());
        const Slack wide_a = larger(a.up, a.down), wide_b = larger(b.up, b.down);
        const FloatVec k_a = swing(a, wide_a), k_b = swing(b, wide_b);
        const Slack cross = {hn::Mul(wide_a.e0, wide_b.e0), hn::MulAdd(wide_a.e0, k_b, hn::Mul(wide_b.e0, k_a)),
                             hn::Mul(k_a, k_b)};
        const auto a_falls = hn::Lt(a.value, zero), b_falls = hn::Lt(b.value, zero);
        const FloatVec size_a = hn::Abs(a.value), size_b = hn::Abs(b.value);
        const auto sum = [&](const Slack& with_a, const Slack& with_b) HWY_ATTR {
            return HWY_NAMESPACE::plus(HWY_NAMESPACE::plus(times(with_b, size_a), times(with_a, size_b)), cross);
        };
        Number result{hn::Mul(a.value, b.value),
                      mul_add(a.value, b.gradient, HWY_NAMESPACE::scaled(a.gradient, b.value)),
                      sum(choose(b_falls, a.down, a.up), choose(a_falls, b.down, b.up)),
                      sum(choose(b_falls, a.up, a.down), choose(a_falls, b.up, b.down))};
        // The terms of the gradient may cancel.
        widen(result, set(0.0f), hn::Mul(set(kOperation), hn::MulAdd(size_a, k_b, hn::Mul(size_b, k_a))));
        return finished(result);
    }

    // Taylor's formula about the value: g(v + p) <= g(v) + g'(v) p + bend p^2 / 2.
    template <class Curve>
    HWY_INLINE Number curved(const Curve& curve, const Number& a) const {
        const FloatVec reach = hn::Mul(length(a.gradient), points_.radius);
        const Lanes v{a.value}, low{hn::Sub(a.value, hn::Add(reach, a.down.at(points_.radius)))},
            high{hn::Add(a.value, hn::Add(reach, a.up.at(points_.radius)))};
        const FloatVec value = curve.value(v).v, slope = curve.slope(v).v, steep = hn::Abs(slope);
        const Slack wide = larger(a.up, a.down);
        const FloatVec k = swing(a, wide), two = set(2.0f);
        const Slack square = {hn::Mul(wide.e0, wide.e0), hn::Mul(two, hn::Mul(wide.e0, k)), hn::Mul(k, k)};
        const auto falls = hn::Lt(slope, hn::Zero(FloatTag()));
        const auto bound = [&](const Slack& linear, FloatVec bend) HWY_ATTR {
            const FloatVec half = hn::MulAdd(set(0.5f + 0x1p-12f), bend, set(0x1p-18f));
            return HWY_NAMESPACE::plus(times(linear, steep), times(square, half));
        };
        Number result{value, HWY_NAMESPACE::scaled(a.gradient, slope),
                      bound(choose(falls, a.down, a.up), curve.bend_up(low, high).v),
                      bound(choose(falls, a.up, a.down), curve.bend_down(low, high).v)};
        // Of the value; and of the slope, which takes p with it.
        const FloatVec off = hn::MulAdd(set(kCurveError), hn::Abs(value), set(kCurveError));
        const FloatVec tilt = hn::MulAdd(set(kCurveError), steep, set(kCurveError));
        widen(result, hn::MulAdd(tilt, wide.e0, off), hn::Mul(tilt, k));
        return finished(result);
    }

    // Taylor's formula for noise: n(q + E) <= n + grad n . E + H |E|^2 / 2 in lattice units, E = w (J D + e).
    HWY_INLINE Number octave(std::size_t k, const Domain& at) {
        const TraceOctave& octave = plan_.octaves[index_][k];
        const OctaveSample n = sample_octave<kPlanar>(octave, at.at, at.reach);
        count();
        const FloatVec frequency = set(octave.frequency);
        const FloatPoint there = HWY_NAMESPACE::scaled({n.dx, n.dy, n.dz}, frequency);
        const auto& errors = kPlanar ? noise::kFloatErrors2 : noise::kFloatErrors3;
        const double wave = octave.wave;
        const FloatVec half_bend = set(0.5 * bounds().second * wave * wave * kRoundUp);
        Slack slack = {set(errors.value), hn::Mul(set(errors.slope * wave), at.stretch),
                       hn::Mul(half_bend, hn::Mul(at.stretch, at.stretch))};
        if (at.is_plain) return finished({n.value, there, slack, slack});
        slack = HWY_NAMESPACE::plus(slack, times(at.slack, set(bounds().gradient * wave * kRoundUp)));
        slack.e0 = hn::MulAdd(half_bend, hn::Mul(at.slack.e0, at.slack.e0), slack.e0);
        slack.e1 = hn::MulAdd(half_bend, hn::Mul(set(2.0f), hn::Mul(at.stretch, at.slack.e0)), slack.e1);
        FloatPoint gradient = HWY_NAMESPACE::scaled(at.rows[0], there.x);
        gradient = mul_add(there.z, at.rows[2], gradient);
        if constexpr (!kPlanar) gradient = mul_add(there.y, at.rows[1], gradient);
        // Its terms may cancel.
        slack.e1 = hn::MulAdd(set(kOperation * bounds().gradient * wave), at.stretch, slack.e1);
        return finished({n.value, gradient, slack, slack});
    }

    struct Running {
        Number sum;
        hn::Mask<FloatTag> open;
        FloatVec above, below;  // what the octaves left out may add and take
    };

    HWY_INLINE Running begin_sum() const {
        const FloatVec zero = hn::Zero(FloatTag());
        return {constant(0.0), points_.active, zero, zero};
    }

    // Whether octave k is to be evaluated in any lane. Where it is too fine it and all after it stay between low and
    // high, low <= 0 <= high.
    HWY_INLINE bool sees(Running& running, std::size_t k, const Domain& at, double low, double high) {
        const FloatTag d;
        const FloatVec wave = set(plan_.octaves[index_][k].wave);
        const FloatVec ball = hn::MulAdd(at.stretch, points_.radius, at.slack.e0);
        const auto fits = hn::Or(points_.whole, hn::Le(hn::Mul(wave, ball), set(kReliefCellsAhead)));
        const auto closes = hn::AndNot(fits, running.open);
        running.above = hn::Add(running.above, hn::IfThenElseZero(closes, set(high * kRoundUp)));
        running.below = hn::Add(running.below, hn::IfThenElseZero(closes, set(-low * kRoundUp)));
        running.open = hn::And(running.open, fits);
        counted_ = running.open;
        return !hn::AllFalse(d, running.open);
    }

    HWY_INLINE void add(Running& running, const Number& term) const {
        const Number sum = plus(running.sum, term);
        Number& to = running.sum;
        to.value = hn::IfThenElse(running.open, sum.value, to.value);
        to.gradient = {hn::IfThenElse(running.open, sum.gradient.x, to.gradient.x),
                       hn::IfThenElse(running.open, sum.gradient.y, to.gradient.y),
                       hn::IfThenElse(running.open, sum.gradient.z, to.gradient.z)};
        to.up = choose(running.open, sum.up, to.up);
        to.down = choose(running.open, sum.down, to.down);
    }

    HWY_INLINE Number total(const Running& running) const {
        Number sum = running.sum;
        sum.up.e0 = hn::Add(sum.up.e0, running.above);
        sum.down.e0 = hn::Add(sum.down.e0, running.below);
        return sum;
    }

    static HWY_INLINE Displacement no_displacement() { return {constant(0.0), constant(0.0), constant(0.0)}; }

    // at + u. |J' D + e'| gains no more than |u - value|, of which each component is at most its swing.
    HWY_INLINE Domain displaced(const Domain& at, const Displacement& u) const {
        const FloatVec zero = hn::Zero(FloatTag()), one = set(1.0f);
        Domain there = at;
        if (at.is_plain) there.rows = {{{one, zero, zero}, {zero, one, zero}, {zero, zero, one}}};
        there.is_plain = false;
        for (std::size_t i = 0; i < dimensions(); ++i) {
            const std::size_t axis = kPlanar ? 2 * i : i;
            const Slack wide = larger(u[i].up, u[i].down);
            there.stretch = hn::Add(there.stretch, swing(u[i], wide));
            there.slack = HWY_NAMESPACE::plus(there.slack, wide);
            there.rows[axis] = mul_add(one, u[i].gradient, there.rows[axis]);
            Wide& moved = axis == 0 ? there.at.x : axis == 1 ? there.at.y : there.at.z;
            moved = trace::HWY_NAMESPACE::add(moved, to_wide(u[i].value));
        }
        there.slack.e1 = hn::MulAdd(set(kOperation), there.stretch, there.slack.e1);  // the rows' rounding
        there.reach += plan_.displacement[index_];
        return there;
    }

    HWY_INLINE Domain shifted(const Domain& at, int i, double by) const {
        Domain there = at;
        const int axis = kPlanar ? 2 * i : i;
        Wide& moved = axis == 0 ? there.at.x : axis == 1 ? there.at.y : there.at.z;
        moved = each_part([&](auto x) HWY_ATTR { return hn::Add(x, hn::Set(DoubleTag(), by)); }, moved);
        there.reach += std::abs(by);
        return there;
    }

    using Pair = std::pair<Number, Number>;

    // x / R and y / R, R = sqrt(x^2 + y^2 + c^2).
    HWY_INLINE Pair unit(const Number& x, const Number& y, double c) const {
        const Polar at = polar(x, y, c);
        const FloatVec bend = hn::Mul(set(noise::kUnitBend * 1.001), hn::Mul(at.inverse_least, at.inverse_least));
        const FloatVec inverse2 = hn::Mul(at.inverse, at.inverse), inverse3 = hn::Mul(inverse2, at.inverse);
        const FloatVec xx = hn::Mul(hn::MulAdd(y.value, y.value, set(c * c)), inverse3);
        const FloatVec yy = hn::Mul(hn::MulAdd(x.value, x.value, set(c * c)), inverse3);
        const FloatVec xy = hn::Neg(hn::Mul(hn::Mul(x.value, y.value), inverse3));
        return {limited(of_two(x, y, hn::Mul(x.value, at.inverse), xx, xy, bend), set(-1.0f), set(1.0f)),
                limited(of_two(x, y, hn::Mul(y.value, at.inverse), xy, yy, bend), set(-1.0f), set(1.0f))};
    }

    // R - c.
    HWY_INLINE Number norm(const Number& x, const Number& y, double c) const {
        const Polar at = polar(x, y, c);
        return of_two(x, y, hn::Sub(at.r, set(c)), hn::Mul(x.value, at.inverse), hn::Mul(y.value, at.inverse),
                      hn::Mul(at.inverse_least, set(1.001f)));
    }

    // whole * share for a share in [0, 1] and a whole no less than 0.
    HWY_INLINE Number part_of(const Number& whole, const Number& share) const {
        const FloatVec radius = points_.radius;
        const FloatVec top = hn::MulAdd(length(whole.gradient), radius, hn::Add(whole.value, whole.up.at(radius)));
        return limited(product(whole, share), hn::Zero(FloatTag()), top);
    }

    // 1 / (1 + u^2 + v^2)^2, u and v the scaled coordinates; the second derivative by them is at most 4, and
    // Taylor's remainder half of that.
    HWY_INLINE Number fall_off(const Domain& at, double x, double z, double per_x, double per_z) const {
        const auto coordinate = [](const Wide& of, double from, double per) HWY_ATTR {
            return to_float(each_part(
                [&](auto p)
                    HWY_ATTR { return hn::Mul(hn::Sub(p, hn::Set(DoubleTag(), from)), hn::Set(DoubleTag(), per)); },
                of));
        };
        const FloatVec u = coordinate(at.at.x, x, per_x), v = coordinate(at.at.z, z, per_z), one = set(1.0f);
        const FloatVec inverse = hn::Div(one, hn::MulAdd(u, u, hn::MulAdd(v, v, one)));
        const FloatVec value = hn::Mul(inverse, inverse);
        const FloatVec fall = hn::Mul(set(-4.0f), hn::Mul(value, inverse));
        const double per = std::max(per_x, per_z) * kRoundUp;
        Number result = at_place(at, value, hn::Mul(hn::Mul(fall, u), set(per_x)),
                                 hn::Mul(hn::Mul(fall, v), set(per_z)), set(1.08 * per), set(2.0 * per * per));
        widen(result, set(0x1p-20f), set(0x1p-20 * per));
        return finished(result);
    }

    HWY_INLINE Pair stripe(std::size_t k, const Domain& at, const Number& dx, const Number& dz, double bands) {
        const TraceOctave& octave = plan_.octaves[index_][k];
        const noise::StripeBounds of(bands);
        count();
        const StripeSample sample = sample_stripe(octave, at.at, at.reach, dx.value, dz.value, bands);
        // |change of p| <= place.e0 + place.e1 |D| in lattice units, and likewise of d.
        const FloatVec wave = set(octave.wave * kRoundUp);
        const Slack wide_x = larger(dx.up, dx.down), wide_z = larger(dz.up, dz.down);
        const Slack place = {hn::Mul(wave, at.slack.e0), hn::Mul(wave, at.stretch), hn::Zero(FloatTag())};
        const FloatVec turn0 = hn::Add(wide_x.e0, wide_z.e0), turn1 = hn::Add(swing(dx, wide_x), swing(dz, wide_z));
        const auto twice = [](FloatVec a0, FloatVec a1, FloatVec b0, FloatVec b1, double bend) HWY_ATTR {
            const FloatVec half = set(0.5 * bend * kRoundUp);
            return times(Slack{hn::Mul(a0, b0), hn::MulAdd(a0, b1, hn::Mul(a1, b0)), hn::Mul(a1, b1)}, half);
        };
        Slack second = twice(place.e0, place.e1, place.e0, place.e1, of.place_twice);
        second = HWY_NAMESPACE::plus(second, twice(place.e0, place.e1, turn0, turn1, 2.0 * of.place_direction));
        second = HWY_NAMESPACE::plus(second, twice(turn0, turn1, turn0, turn1, of.direction_twice));
        const auto wave_of = [&](FloatVec value, FloatVec by_x, FloatVec by_z, FloatVec by_dx,
                                 FloatVec by_dz) HWY_ATTR {
            const FloatVec frequency = set(octave.frequency);
            Number here = at_place(at, value, hn::Mul(by_x, frequency), hn::Mul(by_z, frequency),
                                   hn::Mul(wave, set(of.by_place)), hn::Zero(FloatTag()));
            here = turned(turned(here, dx, by_dx), dz, by_dz);
            here.up = HWY_NAMESPACE::plus(here.up, second);
            here.down = HWY_NAMESPACE::plus(here.down, second);
            // Sines and angles are off by a few 2^-24 turns, slopes by as much times `wave`.
            const float off = static_cast<float>(kStripeError * (1.0 + of.wave));
            widen(here, hn::MulAdd(set(off), turn0, set(off)),
                  hn::Mul(set(off * static_cast<float>(1.0 + of.wave)), hn::Add(place.e1, turn1)));
            return limited(finished(here), set(-1.0f), set(1.0f));
        };
        return {wave_of(sample.c, sample.c_x, sample.c_z, sample.c_dx, sample.c_dz),
                wave_of(sample.s, sample.s_x, sample.s_z, sample.s_dx, sample.s_dz)};
    }

    // Only where the result is used: elsewhere a part's bounds may be of no use without harm.
    Number input(std::size_t i, const Domain& at) const {
        ReliefPoints points = points_;
        points.active = counted_;
        return of(plan_, part().inputs[i], at, points);
    }

    // The relief's part `index`, read at a domain.
    static HWY_NOINLINE Number of(const ReliefPlan& plan, std::size_t index, const Domain& at,
                                  const ReliefPoints& points) {
        LaneNumbers numbers(plan, index, points);
        Number result = constant(0.0);
        std::visit([&](const auto& node) HWY_ATTR { result = noise::HWY_NAMESPACE::relief_of(node, numbers, at); },
                   plan.relief->parts()[index].node);
        return result;
    }

  private:
    HWY_INLINE Number finished(const Number& x) const { return rounded(x, points_, counted_); }

    struct Polar {
        FloatVec r, inverse, inverse_least;  // at the point, and 1 over the least R in the ball
    };
    HWY_INLINE Polar polar(const Number& x, const Number& y, double c) const {
        const FloatVec c2 = set(c * c), one = set(1.0f);
        const FloatVec square = hn::MulAdd(x.value, x.value, hn::Mul(y.value, y.value));
        const FloatVec r = hn::Sqrt(hn::Add(square, c2));
        const FloatVec radius = points_.radius;
        const Slack wide_x = larger(x.up, x.down), wide_y = larger(y.up, y.down);
        const FloatVec reach_x = hn::MulAdd(length(x.gradient), radius, wide_x.at(radius));
        const FloatVec reach_y = hn::MulAdd(length(y.gradient), radius, wide_y.at(radius));
        const FloatVec nearest =
            hn::Max(hn::Sub(hn::Mul(hn::Sqrt(square), set(0.9999f)), hn::Add(reach_x, reach_y)), hn::Zero(FloatTag()));
        const FloatVec least = hn::Sqrt(hn::MulAdd(nearest, nearest, c2));
        return {r, hn::Div(one, r), hn::Div(set(1.0001f), least)};
    }

    // A function of x and y with the slopes fx and fy by them, and second derivatives of at most `bend` in the ball.
    HWY_INLINE Number of_two(const Number& x, const Number& y, FloatVec value, FloatVec fx, FloatVec fy,
                             FloatVec bend) const {
        const FloatVec zero = hn::Zero(FloatTag());
        const Slack none = no_slack();
        Number result = turned(turned({value, {zero, zero, zero}, none, none}, x, fx), y, fy);
        const Slack wide_x = larger(x.up, x.down), wide_y = larger(y.up, y.down);
        const FloatVec kx = swing(x, wide_x), ky = swing(y, wide_y), two = set(2.0f), half = hn::Mul(set(0.5f), bend);
        const Slack square = {hn::MulAdd(wide_x.e0, wide_x.e0, hn::Mul(wide_y.e0, wide_y.e0)),
                              hn::Mul(two, hn::MulAdd(wide_x.e0, kx, hn::Mul(wide_y.e0, ky))),
                              hn::MulAdd(kx, kx, hn::Mul(ky, ky))};
        result.up = HWY_NAMESPACE::plus(result.up, times(square, half));
        result.down = HWY_NAMESPACE::plus(result.down, times(square, half));
        const FloatVec tilt = hn::Mul(set(kCurveError), hn::Add(set(1.0f), hn::Add(hn::Abs(fx), hn::Abs(fy))));
        widen(result,
              hn::MulAdd(tilt, hn::Add(wide_x.e0, wide_y.e0),
                         hn::MulAdd(set(kCurveError), hn::Abs(value), set(kCurveError))),
              hn::Mul(tilt, hn::Add(kx, ky)));
        return finished(result);
    }

    // x, which is known to lie in [low, high]: in balls over which its own bounds allow more on a side, these bound it
    // there, without a gradient.
    HWY_INLINE Number limited(Number x, FloatVec low, FloatVec high) const {
        const FloatVec zero = hn::Zero(FloatTag()), radius = points_.radius;
        const FloatVec off = set(kCurveError);  // values are rounded
        const FloatVec above = hn::Max(hn::Add(hn::Sub(high, x.value), off), off);
        const FloatVec below = hn::Max(hn::Add(hn::Sub(x.value, low), off), off);
        const FloatVec steep = length(x.gradient), turn = hn::Mul(steep, radius);
        const auto loose =
            hn::Or(hn::Gt(hn::Add(turn, x.up.at(radius)), above), hn::Gt(hn::Add(turn, x.down.at(radius)), below));
        const auto side = [&](Slack own, FloatVec most) HWY_ATTR {
            own.e1 = hn::Add(own.e1, steep);
            return choose(hn::Gt(own.at(radius), most), {most, zero, zero}, own);
        };
        x.up = choose(loose, side(x.up, above), x.up);
        x.down = choose(loose, side(x.down, below), x.down);
        x.gradient = {hn::IfThenZeroElse(loose, x.gradient.x), hn::IfThenZeroElse(loose, x.gradient.y),
                      hn::IfThenZeroElse(loose, x.gradient.z)};
        return x;
    }

    // result + slope (x - its value), with x's bounds.
    static HWY_INLINE Number turned(Number result, const Number& x, FloatVec slope) {
        const auto falls = hn::Lt(slope, hn::Zero(FloatTag()));
        const FloatVec steep = hn::Abs(slope);
        result.gradient = mul_add(slope, x.gradient, result.gradient);
        result.up = HWY_NAMESPACE::plus(result.up, times(choose(falls, x.down, x.up), steep));
        result.down = HWY_NAMESPACE::plus(result.down, times(choose(falls, x.up, x.down), steep));
        return result;
    }

    // A function of the place, with the slopes by x and z at it, none steeper than `steepest`, and half_bend half the
    // bound of its second derivative.
    HWY_INLINE Number at_place(const Domain& at, FloatVec value, FloatVec by_x, FloatVec by_z, FloatVec steepest,
                               FloatVec half_bend) const {
        const FloatVec zero = hn::Zero(FloatTag());
        Slack slack = {zero, zero, hn::Mul(half_bend, hn::Mul(at.stretch, at.stretch))};
        if (at.is_plain) return {value, {by_x, zero, by_z}, slack, slack};
        slack = HWY_NAMESPACE::plus(slack, times(at.slack, steepest));
        slack.e0 = hn::MulAdd(half_bend, hn::Mul(at.slack.e0, at.slack.e0), slack.e0);
        slack.e1 = hn::MulAdd(half_bend, hn::Mul(set(2.0f), hn::Mul(at.stretch, at.slack.e0)), slack.e1);
        slack.e1 = hn::MulAdd(hn::Mul(set(kOperation), steepest), at.stretch, slack.e1);
        return {value, mul_add(by_z, at.rows[2], HWY_NAMESPACE::scaled(at.rows[0], by_x)), slack, slack};
    }

    // k with |a - value| <= e0 + k |D| in the ball.
    HWY_INLINE FloatVec swing(const Number& a, const Slack& wide) const {
        return hn::Add(length(a.gradient), hn::MulAdd(wide.e2, points_.radius, wide.e1));
    }

    HWY_INLINE void count() {
        const FloatTag d;
        points_.counters->noise_evaluations += hn::CountTrue(d, counted_);
        points_.counters->executed_lanes += hn::Lanes(d);
        *points_.evaluations = hn::Add(*points_.evaluations, hn::IfThenElseZero(counted_, set(1.0f)));
    }

    const ReliefPlan& plan_;
    std::size_t index_;
    const ReliefPoints& points_;
    hn::Mask<FloatTag> counted_;
};

// Sums of products of numbers no less than 0, each rounded a few hundred times at most.
HWY_INLINE Slack inflated(const Slack& slack) { return times(slack, set(1.0f + 0x1p-14f)); }

// The whole relief at a vector of points, reach a bound of their coordinates.
template <bool kPlanar>
HWY_INLINE Enclosure enclose(const ReliefPlan& plan, const WidePoint& x, double reach, const ReliefPoints& points) {
    Enclosure all =
        LaneNumbers<kPlanar>::of(plan, plan.relief->parts().size() - 1, LaneNumbers<kPlanar>::domain(x, reach), points);
    // Of broken lanes nothing is known, at any distance.
    const FloatVec unknown = set(1e30f);
    const Slack none = {unknown, unknown, hn::Zero(FloatTag())};
    all.up = choose(*points.broken, none, inflated(all.up));
    all.down = choose(*points.broken, none, inflated(all.down));
    return all;
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
