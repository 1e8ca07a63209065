// Reliefs on a vector of points, each with bounds in a ball around its point. Include after hwy/foreach_target.h and
// hwy/highway.h, with STRATA_RELIEF_FORMULAS defined.
#if defined(STRATA_TRACE_RELIEF_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_RELIEF_LANES_INL_H_
#undef STRATA_TRACE_RELIEF_LANES_INL_H_
#else
#define STRATA_TRACE_RELIEF_LANES_INL_H_
#endif

#include <array>
#include <utility>
#include <variant>

#include "noise/float_error.h"
#include "noise/relief/nodes/all.h"
#include "noise/relief/stripe.h"
#include "src/trace/pits-inl.h"
#include "src/trace/relief_sum-inl.h"
#include "src/trace/stripe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Sines, cosines and their angles (stripe-inl.h).
inline constexpr double kStripeError = 0x1p-19;

// The numbers that the relief nodes' formulas are read with.
template <bool kPlanar>
class LaneNumbers : public LaneSums<kPlanar> {
  public:
    using Sums = LaneSums<kPlanar>;
    using Sums::constant;
    using Sums::curved;
    using Sums::dimensions;
    using Sums::plus;
    using Sums::scaled_by;
    using typename Sums::Domain;
    using typename Sums::Number;
    using typename Sums::Pair;
    using typename Sums::Planes;

    using Displacement = std::array<Number, 3>;

    HWY_INLINE LaneNumbers(const ReliefPlan& plan, std::size_t index, const ReliefPoints& points)
        : Sums(plan, index, points, kPlanar ? 2 : 3) {}

    static HWY_INLINE Domain domain(const WidePoint& at, double reach) {
        return {at, true, {}, set(1.0f), no_slack(), reach};
    }

    // `by` times the noise. Taylor's formula: n(q + E) <= n + grad n . E + H |E|^2 / 2 in lattice units, E = w (J D +
    // e).
    HWY_INLINE Number octave(std::size_t k, const Domain& at, double by = 1.0) {
        const TraceOctave& octave = plan_.octaves[index_][k];
        const noise::PlanTurn* turn = this->turn(k);
        const OctaveSample n = turn == nullptr ? sample_octave<kPlanar>(octave, at.at, at.reach)
                                               : sample_turned<kPlanar>(octave, *turn, at.at, at.reach);
        count();
        const auto& errors = kPlanar ? noise::kFloatErrors2 : noise::kFloatErrors3;
        const noise::NoiseBounds& of = this->bounds();
        const double size = std::abs(by) * kRoundingsOfSlack, per = size * octave.wave;
        const FloatVec value = hn::Mul(n.value, set(by));
        const FloatPoint there = Planes::scaled({n.dx, n.dy, n.dz}, set(octave.frequency * by));
        // The terms of a gradient that is turned back, or that goes through a bent domain, may cancel.
        const double roundings = 1.0 + (turn != nullptr ? 2.0 : 0.0) + (at.is_plain ? 0.0 : 2.0);
        const double tilt = errors.slope + roundings * kOperation * of.gradient;
        const FloatVec half_bend = set(0.5 * of.second * octave.wave * per);
        Slack slack = {set((errors.value + kOperation * of.value) * size), hn::Mul(set(tilt * per), at.stretch),
                       hn::Mul(half_bend, hn::Mul(at.stretch, at.stretch))};
        if (at.is_plain) return {value, there, slack, slack};
        const FloatVec off = at.slack.e0;
        slack = HWY_NAMESPACE::mul_add(at.slack, set(of.gradient * per), slack);
        slack.e0 = hn::MulAdd(half_bend, hn::Mul(off, off), slack.e0);
        slack.e1 = hn::MulAdd(half_bend, hn::Mul(hn::Add(at.stretch, at.stretch), off), slack.e1);
        FloatPoint gradient = Planes::mul_add(there.z, at.rows[2], Planes::scaled(at.rows[0], there.x));
        if constexpr (!kPlanar) gradient = Planes::mul_add(there.y, at.rows[1], gradient);
        const Number result{value, gradient, slack, slack};
        check(result, points_, counted_);
        return result;
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

    // per_x x + per_z z + offset; up to a whole number if that is all that matters.
    HWY_INLINE Number along(const Domain& at, double per_x, double per_z, double offset, bool repeats) const {
        Wide place = mul_add(at.at.x, per_x, offset);
        place = each_part([&](auto z, auto rest) HWY_ATTR { return hn::MulAdd(z, hn::Set(DoubleTag(), per_z), rest); },
                          at.at.z, place);
        if (repeats) place = sub(place, floor(place));
        return finished(at_place(at, to_float(place), set(per_x), set(per_z), set(std::hypot(per_x, per_z) * kRoundUp),
                                 hn::Zero(FloatTag())));
    }

    HWY_INLINE Number pits(std::size_t k, const Domain& at, double worn) {
        const TraceOctave& octave = plan_.octaves[index_][k];
        count();
        const Corners corners = corners_of(octave, at.at, at.reach);
        const FloatVec wave = set(octave.wave * kRoundUp), radius = points_.radius;
        const FloatVec ball = hn::Mul(wave, hn::MulAdd(at.stretch, radius, at.slack.at(radius)));
        const noise::HWY_NAMESPACE::HermiteCurve profile{noise::kPitProfile};
        Number sum = constant(0.0);
        for (unsigned corner = 0; corner < 4; ++corner) {
            const PitSample pit = sample_pit(corners, corner, worn);
            const FloatVec away = hn::Sqrt(hn::MulAdd(pit.x, pit.x, hn::Mul(pit.z, pit.z)));
            const auto reached = hn::Lt(hn::Sub(away, ball), hn::Mul(set(noise::kPitReach * 1.001), pit.radius));
            if (hn::AllFalse(FloatTag(), hn::And(reached, counted_))) continue;
            const FloatVec inverse = hn::Div(set(1.0f), pit.radius), inverse2 = hn::Mul(inverse, inverse);
            const FloatVec twice = hn::Mul(set(2.0 * octave.frequency), inverse2);
            const FloatVec steepest = hn::Mul(hn::Mul(set(2.001f), wave), hn::Mul(hn::Add(away, ball), inverse2));
            Number q = at_place(at, hn::Mul(hn::Mul(away, away), inverse2), hn::Mul(twice, pit.x),
                                hn::Mul(twice, pit.z), steepest, hn::Mul(hn::Mul(wave, wave), inverse2));
            if (at.is_plain) q.down.e2 = hn::Zero(FloatTag());  // q is quadratic: it lies above its tangent
            // Places are off by a few 2^-24 cells: q by as much times its slope there, no more than 4 / radius.
            widen(q, hn::Mul(set(0x1p-19f), inverse),
                  hn::Mul(set(0x1p-20f), hn::Add(steepest, hn::Mul(wave, inverse2))));
            sum = plus(sum, scaled_by(curved(profile, finished(q)), hn::Mul(pit.radius, pit.depth)));
        }
        // In larger balls there may be others: what holds of all of them.
        constexpr noise::PitBounds of;
        const FloatVec zero = hn::Zero(FloatTag());
        const auto is_large = hn::Gt(ball, set(noise::kPitMargin * 0.999));
        const auto wider = [&](const Slack& own, double bend) HWY_ATTR {
            const FloatVec half_bend = hn::Mul(hn::Mul(wave, wave), set(2.0 * bend / noise::kNarrowest * kRoundUp));
            const Number any = at_place(at, sum.value, zero, zero, hn::Mul(wave, set(4.0 * of.slope)), half_bend);
            return choose(is_large, HWY_NAMESPACE::plus(own, any.up), own);
        };
        sum.up = wider(sum.up, of.bend_up);
        sum.down = wider(sum.down, of.bend_down);
        return finished(sum);
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
            const double off = kStripeError * (1.0 + of.wave), tilt = off * (1.0 + of.wave);
            widen(here, hn::MulAdd(set(tilt), hn::Add(place.e0, turn0), set(off)),
                  hn::Mul(set(tilt), hn::Add(place.e1, turn1)));
            return between(finished(here), set(-1.0f), set(1.0f));
        };
        return {wave_of(sample.c, sample.c_x, sample.c_z, sample.c_dx, sample.c_dz),
                wave_of(sample.s, sample.s_x, sample.s_z, sample.s_dx, sample.s_dz)};
    }

    // Only where the result is used: elsewhere a part's bounds may be of no use without harm.
    Number input(std::size_t i, const Domain& at) const {
        ReliefPoints points = points_;
        points.active = counted_;
        return of(plan_, this->part().inputs[i], at, points);
    }

    // The relief's part `index`, read at a domain.
    static HWY_NOINLINE Number of(const ReliefPlan& plan, std::size_t index, const Domain& at,
                                  const ReliefPoints& points) {
        LaneNumbers numbers(plan, index, points);
        Number result = constant(0.0);
        std::visit(
            [&](const auto& node) HWY_ATTR {
                // Space has no relief that is one of height fields alone.
                if constexpr (kPlanar || !requires { node.kPlaneOnly; }) {
                    result = noise::HWY_NAMESPACE::relief_of(node, numbers, at);
                }
            },
            plan.relief->parts()[index].node);
        return result;
    }

  private:
    using Sums::at_place;
    using Sums::between;
    using Sums::count;
    using Sums::counted_;
    using Sums::finished;
    using Sums::index_;
    using Sums::plan_;
    using Sums::points_;
    using Sums::swing;
    using Sums::turned;
};

template <bool kPlanar>
Enclosure enclose(const ReliefPlan& plan, const WidePoint& x, double reach, const ReliefPoints& points) {
    Enclosure all =
        LaneNumbers<kPlanar>::of(plan, plan.relief->parts().size() - 1, LaneNumbers<kPlanar>::domain(x, reach), points);
    check(all, points, points.active);
    // Of broken lanes nothing is known, at any distance.
    const FloatVec unknown = set(1e30f);
    const Slack none = {unknown, unknown, hn::Zero(FloatTag())};
    all.up = choose(*points.broken, none, all.up);
    all.down = choose(*points.broken, none, all.down);
    all.gradient = GradientRules<false>::zero_where(*points.broken, all.gradient);
    return all;
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
