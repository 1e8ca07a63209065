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
        FloatVec off = hn::MulAdd(set(kCurveError), hn::Abs(value), set(kCurveError));
        FloatVec tilt = hn::MulAdd(set(kCurveError), steep, set(kCurveError));
        if constexpr (requires { curve.value_unit(v); }) {
            off = hn::MulAdd(set(kCurveError), curve.value_unit(v).v, off);
            tilt = hn::MulAdd(set(kCurveError), curve.slope_unit(v).v, tilt);
        }
        widen(result, hn::MulAdd(tilt, wide.e0, off), hn::Mul(tilt, k));
        if constexpr (requires { Curve::kHasSpan; }) {
            const auto span = curve.span(low, high);
            result = limited(result, hn::Sub(span.low.v, off), hn::Add(span.high.v, off));
        }
        return finished(result);
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
        const FloatVec k = swing(d, wide), reach = hn::MulAdd(length(d.gradient), radius, wide.at(radius));
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
        widen(result, hn::Mul(set(kOperation), sizes),
              hn::Mul(set(kCurveError), hn::Add(swings, hn::Mul(wide.e0, hn::Div(set(1.0f), r)))));
        return finished(result);
    }

    // By a factor of its own in every lane, no less than 0.
    HWY_INLINE Number scaled_by(const Number& a, FloatVec by) const {
        return finished(
            {hn::Mul(a.value, by), HWY_NAMESPACE::scaled(a.gradient, by), times(a.up, by), times(a.down, by)});
    }

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

  protected:
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
        // Where low or high is not a number these are none, and x keeps its own bounds.
        const auto at_least_off = [&](FloatVec v) HWY_ATTR { return hn::IfThenElse(hn::Lt(v, off), off, v); };
        const FloatVec above = at_least_off(hn::Add(hn::Sub(high, x.value), off));
        const FloatVec below = at_least_off(hn::Add(hn::Sub(x.value, low), off));
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

    // k with |a - value| <= e0 + k |D| in the ball.
    HWY_INLINE FloatVec swing(const Number& a, const Slack& wide) const {
        return hn::Add(length(a.gradient), hn::MulAdd(wide.e2, points_.radius, wide.e1));
    }

    const ReliefPoints& points_;
    hn::Mask<FloatTag> counted_;  // the lanes whose results are used
};

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
