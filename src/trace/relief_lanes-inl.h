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
#include "noise/relief/frame.h"
#include "noise/relief/nodes/all.h"
#include "noise/relief/stripe.h"
#include "src/trace/enclosure_rules-inl.h"
#include "src/trace/pits-inl.h"
#include "src/trace/relief_enclosure-inl.h"
#include "src/trace/stripe-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Sines, cosines and their angles (stripe-inl.h).
inline constexpr double kStripeError = 0x1p-19;

// Octaves are evaluated where the ball is smaller than this many of their lattice cells. Speed only.
inline constexpr float kReliefCellsAhead = 0.3f;

// The numbers that the relief nodes' formulas are read with.
template <bool kPlanar>
class LaneNumbers : public noise::ReliefFrame, public EnclosureRules {
  public:
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
          EnclosureRules(points),
          plan_(plan),
          index_(index) {}

    static HWY_INLINE Domain domain(const WidePoint& at, double reach) {
        return {at, true, {}, set(1.0f), no_slack(), reach};
    }

    // Taylor's formula for noise: n(q + E) <= n + grad n . E + H |E|^2 / 2 in lattice units, E = w (J D + e).
    HWY_INLINE Number octave(std::size_t k, const Domain& at) {
        const TraceOctave& octave = plan_.octaves[index_][k];
        const noise::PlanTurn* turn = ReliefFrame::turn(k);
        const OctaveSample n = turn == nullptr ? sample_octave<kPlanar>(octave, at.at, at.reach)
                                               : sample_turned<kPlanar>(octave, *turn, at.at, at.reach);
        count();
        const FloatVec frequency = set(octave.frequency);
        const FloatPoint there = HWY_NAMESPACE::scaled({n.dx, n.dy, n.dz}, frequency);
        const auto& errors = kPlanar ? noise::kFloatErrors2 : noise::kFloatErrors3;
        const double wave = octave.wave;
        const FloatVec half_bend = set(0.5 * bounds().second * wave * wave * kRoundUp);
        Slack slack = {set(errors.value), hn::Mul(set(errors.slope * wave), at.stretch),
                       hn::Mul(half_bend, hn::Mul(at.stretch, at.stretch))};
        // The terms of a gradient that is turned back may cancel.
        if (turn != nullptr) {
            slack.e1 = hn::MulAdd(set(2.0 * kOperation * bounds().gradient * wave), at.stretch, slack.e1);
        }
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
        return sees_cells(running, plan_.octaves[index_][k].wave, at, low, high);
    }

    // The same of a term with so many cells a unit.
    HWY_INLINE bool sees_cells(Running& running, double cells, const Domain& at, double low, double high) {
        return sees_within(running, cells, at, set(-low * kRoundUp), set(high * kRoundUp));
    }

    // The same where octave k and all after it stay between 0 and both `most` and `per_weight` times a weight.
    HWY_INLINE bool sees_weighed(Running& running, std::size_t k, const Domain& at, const Number& weight, double most,
                                 double per_weight) {
        const FloatVec radius = points_.radius;
        const FloatVec top = hn::MulAdd(length(weight.gradient), radius, hn::Add(weight.value, weight.up.at(radius)));
        const FloatVec of_weight = hn::Mul(hn::Max(top, hn::Zero(FloatTag())), set(per_weight * (1.0 + 0x1p-14)));
        return sees_within(running, plan_.octaves[index_][k].wave, at, hn::Zero(FloatTag()),
                           hn::Min(of_weight, set(most * kRoundUp)));
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
    // below and above: how far what is left out may go.
    HWY_INLINE bool sees_within(Running& running, double cells, const Domain& at, FloatVec below, FloatVec above) {
        const FloatTag d;
        const FloatVec wave = set(cells);
        const FloatVec ball = hn::MulAdd(at.stretch, points_.radius, at.slack.e0);
        const auto fits = hn::Or(points_.whole, hn::Le(hn::Mul(wave, ball), set(kReliefCellsAhead)));
        const auto closes = hn::AndNot(fits, running.open);
        running.above = hn::Add(running.above, hn::IfThenElseZero(closes, above));
        running.below = hn::Add(running.below, hn::IfThenElseZero(closes, below));
        running.open = hn::And(running.open, fits);
        counted_ = running.open;
        return !hn::AllFalse(d, running.open);
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

    HWY_INLINE void count() {
        const FloatTag d;
        points_.counters->noise_evaluations += hn::CountTrue(d, counted_);
        points_.counters->executed_lanes += hn::Lanes(d);
        *points_.evaluations = hn::Add(*points_.evaluations, hn::IfThenElseZero(counted_, set(1.0f)));
    }

    const ReliefPlan& plan_;
    std::size_t index_;
};

template <bool kPlanar>
Enclosure enclose(const ReliefPlan& plan, const WidePoint& x, double reach, const ReliefPoints& points) {
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
