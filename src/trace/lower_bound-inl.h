// Guaranteed lower bounds of f along a vector of rays, as quadratics. Include after hwy/foreach_target.h and
// hwy/highway.h.
#if defined(STRATA_TRACE_LOWER_BOUND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_LOWER_BOUND_INL_H_
#undef STRATA_TRACE_LOWER_BOUND_INL_H_
#else
#define STRATA_TRACE_LOWER_BOUND_INL_H_
#endif

#include "src/trace/octave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// f(s) >= f_here - drop + slope * x - bend * x^2 with x = s / hint: what the chosen bounds of the octaves subtract.
// Relative to the hint every coefficient is of the order of the amplitudes, so none overflows.
struct OctaveBounds {
    FloatVec drop, slope, bend;
};

HWY_INLINE OctaveBounds no_bounds() {
    const FloatTag d;
    return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
}

// Adds the bound that is least at the hinted step for one octave of value v and slope `dv` along the ray, in the lanes
// of `use`. wh is the step in lattice units, ws the same times the ray's speed over the noise's domain.
HWY_INLINE OctaveBounds add_octave(const OctaveBounds& sum, const TracePlan& plan, const TraceOctave& octave,
                                   FloatVec v, FloatVec dv, FloatVec wh, FloatVec ws, hn::Mask<FloatTag> use) {
    const FloatTag d;
    const FloatVec amplitude = hn::IfThenElseZero(use, hn::Set(d, octave.amplitude));
    const FloatVec peak = hn::Set(d, plan.peak);
    const FloatVec rise = hn::Mul(ws, hn::Set(d, plan.slope));
    const FloatVec tangent = hn::Mul(dv, wh);
    const FloatVec bend = hn::Mul(hn::Mul(ws, ws), hn::Set(d, plan.half_bend));
    const FloatVec lipschitz = hn::Add(v, rise), taylor = hn::Add(v, hn::Add(tangent, bend));
    const auto is_taylor = hn::And(hn::Le(taylor, lipschitz), hn::Le(taylor, peak));
    const auto is_peak = hn::AndNot(is_taylor, hn::Lt(peak, lipschitz));
    const FloatVec drop = hn::IfThenElseZero(is_peak, hn::Sub(peak, v));
    const FloatVec climb = hn::IfThenZeroElse(is_peak, hn::IfThenElse(is_taylor, tangent, rise));
    return {hn::MulAdd(amplitude, drop, sum.drop), hn::NegMulAdd(amplitude, climb, sum.slope),
            hn::MulAdd(amplitude, hn::IfThenElseZero(is_taylor, bend), sum.bend)};
}

// First root x > 0 of c0 + c1 x - c2 x^2, c2 >= 0, rounded down; 0 where c0 <= 0; huge where there is none. Of the two
// forms of the root the one that adds terms of equal sign is taken, so that a few ulp are lost at most.
HWY_INLINE FloatVec first_root(FloatVec c0, FloatVec c1, FloatVec c2) {
    const FloatTag d;
    const FloatVec four = hn::Set(d, 4.0f), two = hn::Set(d, 2.0f);
    const FloatVec start = hn::Max(c0, hn::Zero(d));
    // No less than |c1|, also where its square vanishes.
    const FloatVec q = hn::Max(hn::Sqrt(hn::MulAdd(c1, c1, hn::Mul(four, hn::Mul(c2, start)))), hn::Abs(c1));
    const auto falls = hn::Lt(c1, hn::Zero(d));
    const FloatVec numerator = hn::IfThenElse(falls, hn::Mul(two, start), hn::Add(c1, q));
    const FloatVec denominator = hn::IfThenElse(falls, hn::Sub(q, c1), hn::Mul(two, c2));
    const auto has_root = hn::Gt(denominator, hn::Zero(d));
    const FloatVec root = hn::Mul(hn::Div(numerator, denominator), hn::Set(d, static_cast<float>(kRoundDown)));
    const FloatVec none = hn::Set(d, 1e30f);
    return hn::IfThenElseZero(hn::Gt(c0, hn::Zero(d)), hn::IfThenElse(has_root, hn::Min(root, none), none));
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
