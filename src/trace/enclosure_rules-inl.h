// The rules by which enclosures (enclosure-inl.h) of sums, products and functions are had from those of their parts.
// Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_ENCLOSURE_RULES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_ENCLOSURE_RULES_INL_H_
#undef STRATA_TRACE_ENCLOSURE_RULES_INL_H_
#else
#define STRATA_TRACE_ENCLOSURE_RULES_INL_H_
#endif

#include <utility>

#include "noise/relief/stripe.h"
#include "src/trace/enclosure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Gradients of reliefs over the plane have no y.
template <bool kPlanar>
struct GradientRules {
    template <class Op, class... Args>
    static HWY_INLINE FloatPoint each(const Op& op, const Args&... of) {
        if constexpr (kPlanar) return {op(of.x...), hn::Zero(FloatTag()), op(of.z...)};
        return {op(of.x...), op(of.y...), op(of.z...)};
    }
    static HWY_INLINE FloatPoint plus(const FloatPoint& a, const FloatPoint& b) {
        return each([](auto x, auto y) HWY_ATTR { return hn::Add(x, y); }, a, b);
    }
    static HWY_INLINE FloatPoint scaled(const FloatPoint& a, FloatVec by) {
        return each([&](auto x) HWY_ATTR { return hn::Mul(x, by); }, a);
    }
    static HWY_INLINE FloatPoint mul_add(FloatVec by, const FloatPoint& a, const FloatPoint& b) {
        return each([&](auto x, auto y) HWY_ATTR { return hn::MulAdd(by, x, y); }, a, b);
    }
    static HWY_INLINE FloatPoint zero_where(hn::Mask<FloatTag> is_zero, const FloatPoint& a) {
        return each([&](auto x) HWY_ATTR { return hn::IfThenZeroElse(is_zero, x); }, a);
    }
    static HWY_INLINE FloatVec sum_of_sizes(const FloatPoint& a) {
        const FloatVec sum = hn::Add(hn::Abs(a.x), hn::Abs(a.z));
        if constexpr (kPlanar) return sum;
        return hn::Add(sum, hn::Abs(a.y));
    }
    static HWY_INLINE FloatVec length(const FloatPoint& a) {
        FloatVec square = hn::MulAdd(a.x, a.x, hn::Mul(a.z, a.z));
        if constexpr (!kPlanar) square = hn::MulAdd(a.y, a.y, square);
        return hn::Sqrt(square);
    }
};

template <bool kPlanar>
class EnclosureRules {
  public:
    using Number = Enclosure;
    using Pair = std::pair<Number, Number>;

    HWY_INLINE explicit EnclosureRules(const ReliefPoints& points) : points_(points), counted_(points.active) {}

    static HWY_INLINE Number constant(double x) {
        const FloatVec zero = hn::Zero(FloatTag());
        const FloatVec off = set(std::abs(x) * 0x1p-23);
        return {set(x), {zero, zero, zero}, {off, zero, zero}, {off, zero, zero}};
    }
    HWY_INLINE Number plus(const Number& a, const Number& b) const {
        const Gradient gradient = Planes::plus(a.gradient, b.gradient);
        return rounded(
            {hn::Add(a.value, b.value), gradient, HWY_NAMESPACE::plus(a.up, b.up), HWY_NAMESPACE::plus(a.down, b.down)},
            set(kRoundingsOfSlack));
    }
    HWY_INLINE Number scaled(const Number& a, double by) const {
        const FloatVec factor = set(by);
        const Slack& up = by < 0.0 ? a.down : a.up;
        const Slack& down = by < 0.0 ? a.up : a.down;
        return rounded({hn::Mul(a.value, factor), Planes::scaled(a.gradient, factor), up, down},
                       set(std::abs(by) * kRoundingsOfSlack));
    }

    // With a = v + p and b = w + q, a b = v w + v q + w p + p q; |p| and |q| are each bounded by e0 + k |D|.
    HWY_INLINE Number product(const Number& a, const Number& b) const {
        const FloatVec zero = hn::Zero(FloatTag());
        const auto a_falls = hn::Lt(a.value, zero), b_falls = hn::Lt(b.value, zero);
        return product_of(a, b, set(1.0f), {choose(b_falls, a.down, a.up), choose(b_falls, a.up, a.down)},
                          {choose(a_falls, b.down, b.up), choose(a_falls, b.up, b.down)});
    }

    // The same of numbers that are nowhere below 0. If v is, its e0 is larger than -v, and v q is above |v| q by less
    // than twice e0 |q|.
    HWY_INLINE Number product_of_positive(const Number& a, const Number& b) const {
        return product_of(a, b, set(2.0f), {a.up, a.down}, {b.up, b.down});
    }

    // Taylor's formula about the value: g(v + p) <= g(v) + g'(v) p + bend p^2 / 2.
    template <class Curve>
    HWY_INLINE Number curved(const Curve& curve, const Number& a) const {
        const FloatVec radius = points_.radius, steepness = Planes::length(a.gradient);
        const FloatVec reach = hn::Mul(steepness, radius);
        const Lanes v{a.value}, low{hn::Sub(a.value, hn::Add(reach, a.down.at(radius)))},
            high{hn::Add(a.value, hn::Add(reach, a.up.at(radius)))};
        const FloatVec value = curve.value(v).v, slope = curve.slope(v).v, steep = hn::Abs(slope);
        const Slack wide = larger(a.up, a.down);
        const FloatVec k = hn::Add(steepness, hn::MulAdd(wide.e2, radius, wide.e1));
        const FloatVec twice = hn::Add(wide.e0, wide.e0);
        const Slack square = {hn::Mul(wide.e0, wide.e0), hn::Mul(twice, k), hn::Mul(k, k)};
        // Of the value; and of the slope, which takes p with it.
        FloatVec off = hn::MulAdd(set(kCurveError), hn::Abs(value), set(kCurveError));
        FloatVec tilt = hn::MulAdd(set(kCurveError), steep, set(kCurveError));
        if constexpr (requires { curve.value_unit(v); }) {
            off = hn::MulAdd(set(kCurveError), curve.value_unit(v).v, off);
        }
        if constexpr (requires { curve.slope_unit(v); }) {
            tilt = hn::MulAdd(set(kCurveError), curve.slope_unit(v).v, tilt);
        }
        const Slack error = {hn::MulAdd(tilt, wide.e0, off), hn::Mul(tilt, k), hn::Zero(FloatTag())};
        const FloatVec factor = hn::Mul(steep, set(kRoundingsOfSlack));
        const auto bound = [&](const Slack& linear, FloatVec bend) HWY_ATTR {
            const FloatVec half = hn::MulAdd(set(0.5f + 0x1p-12f), bend, set(0x1p-18f));
            return mul_add(linear, factor, mul_add(square, half, error));
        };
        const FloatVec bend_up = curve.bend_up(low, high).v, bend_down = curve.bend_down(low, high).v;
        Number result{value, Planes::scaled(a.gradient, slope), no_slack(), no_slack()};
        if constexpr (requires { Curve::kRises; }) {
            result.up = bound(a.up, bend_up);
            result.down = bound(a.down, bend_down);
        } else {
            const auto falls = hn::Lt(slope, hn::Zero(FloatTag()));
            result.up = bound(choose(falls, a.down, a.up), bend_up);
            result.down = bound(choose(falls, a.up, a.down), bend_down);
        }
        if constexpr (requires { Curve::kLow; }) {
            result = capped(result, set(Curve::kLow), set(Curve::kHigh), hn::Mul(factor, steepness));
        }
        if constexpr (requires { Curve::kHasSpan; }) {
            const auto span = curve.span(low, high);
            result = capped(result, hn::Sub(span.low.v, off), hn::Add(span.high.v, off), hn::Mul(factor, steepness));
        }
        check(result, points_, counted_);
        return result;
    }

    // (1 - s) a + s b for a share s in [0, 1]: with changes p, q and t of a, b and s it changes by
    // (1 - s) p + s q + (b - a) t + (q - p) t.
    HWY_INLINE Number mixed(const Number& a, const Number& b, const Number& share) const {
        const FloatVec zero = hn::Zero(FloatTag()), one = set(1.0f);
        const FloatVec s = hn::Clamp(share.value, zero, one), rest = hn::Sub(one, s);
        const Number apart = plus(b, scaled(a, -1.0));
        const Slack wide_d = larger(apart.up, apart.down), wide_s = larger(share.up, share.down), none = no_slack();
        const FloatVec k_d = swing(apart, wide_d), k_s = swing(share, wide_s);
        Number result{hn::MulAdd(s, apart.value, a.value), {zero, zero, zero}, none, none};
        result = turned(turned(turned(result, a, rest), b, s), share, apart.value);
        const Slack cross = {hn::Mul(wide_d.e0, wide_s.e0), hn::MulAdd(wide_d.e0, k_s, hn::Mul(wide_s.e0, k_d)),
                             hn::Mul(k_d, k_s)};
        result.up = HWY_NAMESPACE::plus(result.up, cross);
        result.down = HWY_NAMESPACE::plus(result.down, cross);
        const FloatVec sizes = hn::Add(hn::Abs(a.value), hn::Abs(b.value));
        const FloatVec swings = hn::Add(swing(a, larger(a.up, a.down)), swing(b, larger(b.up, b.down)));
        widen(result, hn::Mul(set(kOperation), sizes), hn::Mul(set(kOperation), hn::MulAdd(sizes, k_s, swings)));
        return finished(result);
    }

    // (a + b + R) / 2 with R^2 = d^2 + softness^2, d = a - b. By d its second derivative is softness^2 / (2 R^3) >= 0,
    // largest where |d| is least.
    HWY_INLINE Number highest(const Number& a, const Number& b, double softness) const {
        const FloatVec zero = hn::Zero(FloatTag()), half = set(0.5f), radius = points_.radius,
                       soft2 = set(softness * softness);
        const Number d = plus(a, scaled(b, -1.0));
        const Slack wide = larger(d.up, d.down), none = no_slack();
        const FloatVec k = swing(d, wide), reach = hn::MulAdd(Planes::length(d.gradient), radius, wide.at(radius));
        const FloatVec r = hn::Sqrt(hn::MulAdd(d.value, d.value, soft2));
        const FloatVec nearest = hn::Max(hn::Sub(hn::Mul(hn::Abs(d.value), set(0.9999f)), reach), zero);
        const FloatVec least2 = hn::MulAdd(nearest, nearest, soft2);
        const FloatVec half_bend = hn::Div(hn::Mul(set(0.2505f), soft2), hn::Mul(least2, hn::Sqrt(least2)));
        const FloatVec to_a = hn::MulAdd(half, hn::Div(d.value, r), half), to_b = hn::Sub(set(1.0f), to_a);
        Number result{hn::Mul(half, hn::Add(hn::Add(a.value, b.value), r)), {zero, zero, zero}, none, none};
        result = turned(turned(result, a, to_a), b, to_b);
        const Slack square = {hn::Mul(wide.e0, wide.e0), hn::Mul(set(2.0f), hn::Mul(wide.e0, k)), hn::Mul(k, k)};
        // The seam adds no more than it does in all: |change of R / 2 - its tangent| <= |change of d|.
        const Slack seam = times(square, half_bend), linear = {wide.e0, k, zero};
        result.up = HWY_NAMESPACE::plus(result.up, choose(hn::Lt(seam.at(radius), linear.at(radius)), seam, linear));
        const FloatVec sizes = hn::Add(hn::Add(hn::Abs(a.value), hn::Abs(b.value)), r);
        const FloatVec swings = hn::Add(swing(a, larger(a.up, a.down)), swing(b, larger(b.up, b.down)));
        const FloatVec off = hn::Add(larger(a.up, a.down).e0, larger(b.up, b.down).e0);
        widen(result, hn::MulAdd(set(kCurveError), off, hn::Mul(set(kOperation), sizes)),
              hn::Mul(set(kCurveError), hn::Add(swings, hn::Mul(wide.e0, hn::Div(set(1.0f), r)))));
        return finished(result);
    }

    // By a factor of its own in every lane, no less than 0.
    HWY_INLINE Number scaled_by(const Number& a, FloatVec by) const {
        return rounded({hn::Mul(a.value, by), Planes::scaled(a.gradient, by), a.up, a.down},
                       hn::Mul(by, set(kRoundingsOfSlack)));
    }

    // x / R and y / R, R = sqrt(x^2 + y^2 + c^2).
    HWY_INLINE Pair unit(const Number& x, const Number& y, double c) const {
        const Polar at = polar(x, y, c);
        const FloatVec bend = hn::Mul(set(noise::kUnitBend * 1.001), hn::Mul(at.inverse_least, at.inverse_least));
        const FloatVec inverse2 = hn::Mul(at.inverse, at.inverse), inverse3 = hn::Mul(inverse2, at.inverse);
        const FloatVec xx = hn::Mul(hn::MulAdd(y.value, y.value, set(c * c)), inverse3);
        const FloatVec yy = hn::Mul(hn::MulAdd(x.value, x.value, set(c * c)), inverse3);
        const FloatVec xy = hn::Neg(hn::Mul(hn::Mul(x.value, y.value), inverse3));
        return {between(of_two(x, y, hn::Mul(x.value, at.inverse), xx, xy, bend), set(-1.0f), set(1.0f)),
                between(of_two(x, y, hn::Mul(y.value, at.inverse), xy, yy, bend), set(-1.0f), set(1.0f))};
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
        const FloatVec top =
            hn::MulAdd(Planes::length(whole.gradient), radius, hn::Add(whole.value, whole.up.at(radius)));
        return between(product_of_positive(whole, share), hn::Zero(FloatTag()), top);
    }

  protected:
    using Planes = GradientRules<kPlanar>;
    using Gradient = FloatPoint;

    // x with its slacks times `growth`, and with what rounding its value and its gradient adds.
    static HWY_INLINE Number rounded(const Number& x, FloatVec growth) {
        const FloatVec unit = set(kOperation);
        const FloatVec e0 = hn::Mul(unit, hn::Abs(x.value)), e1 = hn::Mul(unit, Planes::sum_of_sizes(x.gradient));
        const Slack error = {e0, e1, hn::Zero(FloatTag())};
        return {x.value, x.gradient, mul_add(x.up, growth, error), mul_add(x.down, growth, error)};
    }

    // The same, of what multiplied slacks with one another.
    HWY_INLINE Number finished(const Number& x) const {
        const Number result = rounded(x, set(kRoundingsOfSlack));
        check(result, points_, counted_);
        return result;
    }

    struct Sides {
        Slack up, down;  // of a factor where the other one is no less than 0, or exchanged
    };

    // far: what |p| and |q| may be of what their own slacks say at the point.
    HWY_INLINE Number product_of(const Number& a, const Number& b, FloatVec far, const Sides& of_a,
                                 const Sides& of_b) const {
        const Slack wide_a = larger(a.up, a.down), wide_b = larger(b.up, b.down);
        const FloatVec k_a = swing(a, wide_a), k_b = swing(b, wide_b), grown = set(kRoundingsOfSlack);
        const FloatVec off_a = hn::Mul(wide_a.e0, far), off_b = hn::Mul(wide_b.e0, far);
        const FloatVec size_a = hn::Abs(a.value), size_b = hn::Abs(b.value);
        // The terms of the gradient may cancel.
        const FloatVec tilt = hn::Mul(set(kOperation), hn::MulAdd(size_a, k_b, hn::Mul(size_b, k_a)));
        const FloatVec value = hn::Mul(a.value, b.value);
        const Slack cross = {
            hn::MulAdd(hn::Mul(off_a, off_b), grown, hn::Mul(set(kOperation), hn::Abs(value))),
            hn::MulAdd(hn::MulAdd(off_a, k_b, hn::Mul(off_b, k_a)), grown, tilt),
            hn::Mul(hn::Mul(k_a, k_b), grown),
        };
        const FloatVec by_a = hn::Mul(size_a, grown), by_b = hn::Mul(size_b, grown);
        const auto sum = [&](const Slack& with_b, const Slack& with_a)
                             HWY_ATTR { return mul_add(with_b, by_a, mul_add(with_a, by_b, cross)); };
        const Number result{value, Planes::mul_add(a.value, b.gradient, Planes::scaled(a.gradient, b.value)),
                            sum(of_b.up, of_a.up), sum(of_b.down, of_a.down)};
        check(result, points_, counted_);
        return result;
    }

    struct Polar {
        FloatVec r, inverse, inverse_least;  // at the point, and 1 over the least R in the ball
    };
    HWY_INLINE Polar polar(const Number& x, const Number& y, double c) const {
        const FloatVec c2 = set(c * c), one = set(1.0f);
        const FloatVec square = hn::MulAdd(x.value, x.value, hn::Mul(y.value, y.value));
        const FloatVec r = hn::Sqrt(hn::Add(square, c2));
        const FloatVec radius = points_.radius;
        const Slack wide_x = larger(x.up, x.down), wide_y = larger(y.up, y.down);
        const FloatVec reach_x = hn::MulAdd(Planes::length(x.gradient), radius, wide_x.at(radius));
        const FloatVec reach_y = hn::MulAdd(Planes::length(y.gradient), radius, wide_y.at(radius));
        const FloatVec nearest =
            hn::Max(hn::Sub(hn::Mul(hn::Sqrt(square), set(0.9999f)), hn::Add(reach_x, reach_y)), hn::Zero(FloatTag()));
        const FloatVec least = hn::Sqrt(hn::MulAdd(nearest, nearest, c2));
        return {r, hn::Div(one, r), hn::Div(set(1.0001f), least)};
    }

    // A function of x and y with the slopes fx and fy by them, and second derivatives of at most `bend` in the ball.
    HWY_INLINE Number of_two(const Number& x, const Number& y, FloatVec value, FloatVec fx, FloatVec fy,
                             FloatVec bend) const {
        const Slack wide_x = larger(x.up, x.down), wide_y = larger(y.up, y.down);
        const FloatVec kx = swing(x, wide_x), ky = swing(y, wide_y), two = set(2.0f), grown = set(kRoundingsOfSlack);
        const Slack square = {hn::MulAdd(wide_x.e0, wide_x.e0, hn::Mul(wide_y.e0, wide_y.e0)),
                              hn::Mul(two, hn::MulAdd(wide_x.e0, kx, hn::Mul(wide_y.e0, ky))),
                              hn::MulAdd(kx, kx, hn::Mul(ky, ky))};
        const FloatVec size_x = hn::Abs(fx), size_y = hn::Abs(fy);
        const FloatVec tilt = hn::Mul(set(kCurveError), hn::Add(set(1.0f), hn::Add(size_x, size_y)));
        const FloatVec off = hn::MulAdd(set(kCurveError), hn::Abs(value), set(kCurveError));
        const Slack error = {hn::MulAdd(tilt, hn::Add(wide_x.e0, wide_y.e0), off), hn::Mul(tilt, hn::Add(kx, ky)),
                             hn::Zero(FloatTag())};
        const Slack both = mul_add(square, hn::Mul(bend, set(0.5 * kRoundingsOfSlack)), error);
        const FloatVec by_x = hn::Mul(size_x, grown), by_y = hn::Mul(size_y, grown);
        const auto x_falls = hn::Lt(fx, hn::Zero(FloatTag())), y_falls = hn::Lt(fy, hn::Zero(FloatTag()));
        const auto bound = [&](const Slack& of_x, const Slack& of_y)
                               HWY_ATTR { return mul_add(of_x, by_x, mul_add(of_y, by_y, both)); };
        const Number result{value, Planes::mul_add(fx, x.gradient, Planes::scaled(y.gradient, fy)),
                            bound(choose(x_falls, x.down, x.up), choose(y_falls, y.down, y.up)),
                            bound(choose(x_falls, x.up, x.down), choose(y_falls, y.up, y.down))};
        check(result, points_, counted_);
        return result;
    }

    HWY_INLINE Number between(const Number& x, FloatVec low, FloatVec high) const {
        return capped(x, low, high, hn::Mul(Planes::length(x.gradient), set(kRoundingsOfSlack)));
    }

    // x, which is known to lie in [low, high], with `steep` no less than its gradient's length. A side that allows more
    // over the ball is bounded by the gradient and that; in large balls by that alone.
    HWY_INLINE Number capped(Number x, FloatVec low, FloatVec high, FloatVec steep) const {
        const FloatVec zero = hn::Zero(FloatTag()), radius = points_.radius;
        const FloatVec off = set(kCurveError);  // values are rounded
        // Where low or high is not a number these are none, and x keeps its own bounds.
        const auto at_least_off = [&](FloatVec v) HWY_ATTR { return hn::IfThenElse(hn::Lt(v, off), off, v); };
        const FloatVec above = at_least_off(hn::Add(hn::Sub(high, x.value), off));
        const FloatVec below = at_least_off(hn::Add(hn::Sub(x.value, low), off));
        const FloatVec turn = hn::Mul(steep, radius), up = x.up.at(radius), down = x.down.at(radius);
        // Nowhere but where the gradient alone goes far beyond the range: normals are taken in balls of radius 0.
        const FloatVec half = hn::Mul(set(0.5f), turn);
        const auto is_flat = hn::And(hn::Gt(half, above), hn::Gt(half, below));
        const FloatVec tilt = hn::IfThenZeroElse(is_flat, steep);
        x.gradient = Planes::zero_where(is_flat, x.gradient);
        x.up = choose(hn::Or(is_flat, hn::Gt(up, hn::Add(above, turn))), {above, tilt, zero}, x.up);
        x.down = choose(hn::Or(is_flat, hn::Gt(down, hn::Add(below, turn))), {below, tilt, zero}, x.down);
        return x;
    }

    // result + slope (x - its value), with x's bounds.
    static HWY_INLINE Number turned(Number result, const Number& x, FloatVec slope) {
        const auto falls = hn::Lt(slope, hn::Zero(FloatTag()));
        const FloatVec steep = hn::Abs(slope);
        result.gradient = Planes::mul_add(slope, x.gradient, result.gradient);
        result.up = HWY_NAMESPACE::plus(result.up, times(choose(falls, x.down, x.up), steep));
        result.down = HWY_NAMESPACE::plus(result.down, times(choose(falls, x.up, x.down), steep));
        return result;
    }

    // k with |a - value| <= e0 + k |D| in the ball.
    HWY_INLINE FloatVec swing(const Number& a, const Slack& wide) const {
        return hn::Add(Planes::length(a.gradient), hn::MulAdd(wide.e2, points_.radius, wide.e1));
    }

    const ReliefPoints& points_;
    hn::Mask<FloatTag> counted_;  // the lanes whose results are used
};

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
