// Sums of octaves in balls around a vector of points: which octaves are evaluated and what is known of the others.
// Include after hwy/foreach_target.h and hwy/highway.h, with STRATA_RELIEF_FORMULAS defined.
#if defined(STRATA_TRACE_RELIEF_SUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_RELIEF_SUM_INL_H_
#undef STRATA_TRACE_RELIEF_SUM_INL_H_
#else
#define STRATA_TRACE_RELIEF_SUM_INL_H_
#endif

#include <array>

#include "noise/relief/frame.h"
#include "src/trace/enclosure_rules-inl.h"
#include "src/trace/relief_enclosure-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Octaves are evaluated where the ball is smaller than this many of their lattice cells; stripes, which bend by far
// more, in smaller balls. Speed only.
inline constexpr float kReliefCellsAhead = 0.25f, kStripeCellsAhead = 0.036f;

// What the numbers of relief nodes have whatever the noise's dimensions.
template <bool kPlanar>
class LaneSums : public noise::ReliefFrame, public EnclosureRules<kPlanar> {
  public:
    using Rules = EnclosureRules<kPlanar>;
    using typename Rules::Number;

    // The point at which a relief is read: `at` + J D + e with |J D + e| <= stretch |D| + slack.e0, |e| <= slack(|D|).
    struct Domain {
        WidePoint at;
        bool is_plain = true;  // J is 1, the slack 0
        std::array<FloatPoint, 3> rows{};
        FloatVec stretch;
        Slack slack;
        double reach;  // bound of |at| on every axis of every lane
    };

    struct Running {
        Number sum;
        hn::Mask<FloatTag> open;
        FloatVec above, below;  // what the octaves left out may add and take
    };

    HWY_INLINE Running begin_sum() const {
        const FloatVec zero = hn::Zero(FloatTag());
        return {Rules::constant(0.0), points_.active, zero, zero};
    }

    // Whether octave k is to be evaluated in any lane. Where it is too fine it and all after it stay between low and
    // high, low <= 0 <= high.
    HWY_INLINE bool sees(Running& running, std::size_t k, const Domain& at, double low, double high) {
        return sees_cells(running, plan_.octaves[index_][k].wave, at, low, high);
    }

    // The same of octaves of stripes.
    HWY_INLINE bool sees_stripe(Running& running, std::size_t k, const Domain& at, double low, double high) {
        constexpr double kFiner = kReliefCellsAhead / kStripeCellsAhead;
        return sees_cells(running, kFiner * plan_.octaves[index_][k].wave, at, low, high);
    }

    // The same of a term with so many cells a unit.
    HWY_INLINE bool sees_cells(Running& running, double cells, const Domain& at, double low, double high) {
        return sees_within(running, cells, at, set(-low * kRoundUp), set(high * kRoundUp));
    }

    // The same where octave k and all after it stay between 0 and both `most` and `per_weight` times a weight.
    HWY_INLINE bool sees_weighed(Running& running, std::size_t k, const Domain& at, const Number& weight, double most,
                                 double per_weight) {
        const FloatVec radius = points_.radius;
        const FloatVec top =
            hn::MulAdd(Planes::length(weight.gradient), radius, hn::Add(weight.value, weight.up.at(radius)));
        const FloatVec of_weight = hn::Mul(hn::Max(top, hn::Zero(FloatTag())), set(per_weight * (1.0 + 0x1p-14)));
        return sees_within(running, plan_.octaves[index_][k].wave, at, hn::Zero(FloatTag()),
                           hn::Min(of_weight, set(most * kRoundUp)));
    }

    // The slacks' own roundings are made good in total().
    HWY_INLINE void add(Running& running, const Number& term) const {
        const auto open = running.open;
        const auto sum = [&](FloatVec a, FloatVec b) HWY_ATTR { return hn::IfThenElse(open, hn::Add(a, b), a); };
        const auto sum_of = [&](const Slack& a, const Slack& b, const Slack& error) HWY_ATTR {
            return Slack{sum(a.e0, hn::Add(b.e0, error.e0)), sum(a.e1, hn::Add(b.e1, error.e1)), sum(a.e2, b.e2)};
        };
        Number& to = running.sum;
        to.value = sum(to.value, term.value);
        to.gradient = Planes::each(sum, to.gradient, term.gradient);
        const FloatVec unit = set(kOperation);
        const Slack error = {hn::Mul(unit, hn::Abs(to.value)), hn::Mul(unit, Planes::sum_of_sizes(to.gradient)),
                             hn::Zero(FloatTag())};
        to.up = sum_of(to.up, term.up, error);
        to.down = sum_of(to.down, term.down, error);
    }

    HWY_INLINE Number total(const Running& running) const {
        Number sum = running.sum;
        sum.up.e0 = hn::Add(sum.up.e0, running.above);
        sum.down.e0 = hn::Add(sum.down.e0, running.below);
        const FloatVec grown = set(kRoundingsOfSlack);
        sum.up = times(sum.up, grown);
        sum.down = times(sum.down, grown);
        return sum;
    }

  protected:
    using Rules::counted_;
    using Rules::points_;
    using typename Rules::Planes;

    HWY_INLINE LaneSums(const ReliefPlan& plan, std::size_t index, const ReliefPoints& points, int dimensions)
        : ReliefFrame(plan.relief->parts()[index], dimensions), Rules(points), plan_(plan), index_(index) {}

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
        return {value, Planes::mul_add(by_z, at.rows[2], Planes::scaled(at.rows[0], by_x)), slack, slack};
    }

    HWY_INLINE void count() {
        const FloatTag d;
        points_.counters->noise_evaluations += hn::CountTrue(d, counted_);
        points_.counters->executed_lanes += hn::Lanes(d);
        *points_.evaluations = hn::Add(*points_.evaluations, hn::IfThenElseZero(counted_, set(1.0f)));
    }

    const ReliefPlan& plan_;
    std::size_t index_;

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
};

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
