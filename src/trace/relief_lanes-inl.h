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

#include "noise/float_error.h"
#include "noise/relief/frame.h"
#include "noise/relief/nodes/all.h"
#include "src/trace/base-inl.h"
#include "src/trace/relief_plan.h"

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

// With what an operation's rounding adds.
HWY_INLINE Enclosure rounded(Enclosure x) {
    const FloatVec unit = set(kOperation);
    const FloatVec e0 = hn::Mul(unit, hn::Abs(x.value));
    const FloatVec sum = hn::Add(hn::Abs(x.gradient.x), hn::Add(hn::Abs(x.gradient.y), hn::Abs(x.gradient.z)));
    widen(x, e0, hn::Mul(unit, sum));
    return x;
}

// What the points of a call share, a lane each.
struct ReliefPoints {
    FloatVec radius;            // of the ball in which the bounds hold
    hn::Mask<FloatTag> active;  // the lanes that are asked for
    hn::Mask<FloatTag> whole;   // those in which no octave is left out
    TraceCounters* counters;    // noise evaluations and lanes are added
    FloatVec* evaluations;      // of each lane, added to
};

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
    static HWY_INLINE Number plus(const Number& a, const Number& b) {
        return rounded({hn::Add(a.value, b.value),
                        {hn::Add(a.gradient.x, b.gradient.x), hn::Add(a.gradient.y, b.gradient.y),
                         hn::Add(a.gradient.z, b.gradient.z)},
                        HWY_NAMESPACE::plus(a.up, b.up),
                        HWY_NAMESPACE::plus(a.down, b.down)});
    }
    static HWY_INLINE Number scaled(const Number& a, double by) {
        const FloatVec factor = set(by), size = set(std::abs(by));
        const Slack& up = by < 0.0 ? a.down : a.up;
        const Slack& down = by < 0.0 ? a.up : a.down;
        return rounded(
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
        return rounded(result);
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
        return rounded(result);
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
        if (at.is_plain) return rounded({n.value, there, slack, slack});
        slack = HWY_NAMESPACE::plus(slack, times(at.slack, set(bounds().gradient * wave * kRoundUp)));
        slack.e0 = hn::MulAdd(half_bend, hn::Mul(at.slack.e0, at.slack.e0), slack.e0);
        slack.e1 = hn::MulAdd(half_bend, hn::Mul(set(2.0f), hn::Mul(at.stretch, at.slack.e0)), slack.e1);
        FloatPoint gradient = HWY_NAMESPACE::scaled(at.rows[0], there.x);
        gradient = mul_add(there.z, at.rows[2], gradient);
        if constexpr (!kPlanar) gradient = mul_add(there.y, at.rows[1], gradient);
        // Its terms may cancel.
        slack.e1 = hn::MulAdd(set(kOperation * bounds().gradient * wave), at.stretch, slack.e1);
        return rounded({n.value, gradient, slack, slack});
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

    Number input(std::size_t i, const Domain& at) const { return of(plan_, part().inputs[i], at, points_); }

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
    all.up = inflated(all.up);
    all.down = inflated(all.down);
    return all;
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
