// Guaranteed lower bounds of f over a vector of beams, as quadratics. Include after hwy/foreach_target.h and
// hwy/highway.h.
#if defined(STRATA_TRACE_BEAM_BOUND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_BEAM_BOUND_INL_H_
#undef STRATA_TRACE_BEAM_BOUND_INL_H_
#else
#define STRATA_TRACE_BEAM_BOUND_INL_H_
#endif

#include "src/trace/base-inl.h"
#include "src/trace/lower_bound-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// How far a step `ahead` along the axis leads in the noise's domain.
struct BeamSpan {
    FloatVec ahead;   // the hinted step
    FloatVec along;   // the same, times the axis' speed over the noise's domain
    FloatVec radius;  // of the beam here
    FloatVec spread;
};

// f >= certain - drop + slope x - bend x^2 with x = step / ahead, without what `gradient` says across the beam.
struct BeamBounds {
    FloatVec drop, slope, bend;
    FloatPoint gradient;  // of the octaves bounded by their tangent, times amplitude
};

HWY_INLINE BeamBounds no_beam_bounds() {
    const FloatVec zero = hn::Zero(FloatTag());
    return {zero, zero, zero, {zero, zero, zero}};
}

// Adds the bound that is least at the end of the hinted step for one octave.
// kLoose: the point's displacement in the noise's domain need not be one along the axis and one across it.
template <bool kPlanar, bool kDriftsInTime>
HWY_INLINE BeamBounds add_octave_beam(const BeamBounds& sum, const TracePlan& plan, const TraceOctave& octave,
                                      const OctaveSample& n, FloatVec dv, const BeamSpan& span,
                                      hn::Mask<FloatTag> use) {
    constexpr bool kLoose = kPlanar || kDriftsInTime;
    const FloatTag d;
    const FloatVec amplitude = hn::IfThenElseZero(use, hn::Set(d, octave.amplitude)), wave = hn::Set(d, octave.wave);
    const FloatVec peak = hn::Set(d, plan.peak), half = hn::Set(d, plan.half_bend);
    // In cells: the step along the axis, the beam's radius here and what it grows by on the step.
    const FloatVec s = hn::Mul(wave, span.along), r = hn::Mul(wave, span.radius);
    const FloatVec grown = hn::Mul(wave, hn::Mul(span.spread, span.ahead));
    const FloatVec far = hn::Add(s, grown);
    const FloatVec across = hn::Sqrt(hn::Max(
        hn::Zero(d), hn::Sub(dot({n.dx, n.dy, n.dz}, {n.dx, n.dy, n.dz}), kLoose ? hn::Zero(d) : hn::Mul(dv, dv))));
    const FloatVec tangent = hn::Mul(hn::Mul(dv, wave), span.ahead);
    // |D|^2 <= bend x^2 + turn x + r^2; loosely |D| <= far x + r.
    const FloatVec bend = kLoose ? hn::Mul(far, far) : hn::MulAdd(s, s, hn::Mul(grown, grown));
    const FloatVec turn = hn::Mul(hn::Add(r, r), kLoose ? far : grown);
    const FloatVec still = hn::Mul(r, r);
    const FloatVec lipschitz = hn::MulAdd(hn::Add(far, r), hn::Set(d, plan.slope), n.value);
    const FloatVec taylor = hn::Add(hn::MulAdd(across, hn::Add(r, grown), hn::Add(n.value, tangent)),
                                    hn::Mul(half, hn::Add(bend, hn::Add(turn, still))));
    const auto is_taylor = hn::And(hn::Le(taylor, lipschitz), hn::Le(taylor, peak));
    const auto is_peak = hn::AndNot(is_taylor, hn::Lt(peak, lipschitz));
    const FloatVec drop = hn::IfThenElse(is_taylor, hn::Mul(half, still), hn::Mul(r, hn::Set(d, plan.slope)));
    const FloatVec climb =
        hn::IfThenElse(is_taylor, hn::MulAdd(half, turn, tangent), hn::Mul(far, hn::Set(d, plan.slope)));
    const FloatVec pull = hn::Mul(amplitude, hn::IfThenElseZero(is_taylor, wave));
    return {hn::MulAdd(amplitude, hn::IfThenElse(is_peak, hn::Sub(peak, n.value), drop), sum.drop),
            hn::NegMulAdd(amplitude, hn::IfThenZeroElse(is_peak, climb), sum.slope),
            hn::MulAdd(amplitude, hn::IfThenElseZero(is_taylor, hn::Mul(half, bend)), sum.bend),
            {hn::MulAdd(pull, n.dx, sum.gradient.x), hn::MulAdd(pull, n.dy, sum.gradient.y),
             hn::MulAdd(pull, n.dz, sum.gradient.z)}};
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
