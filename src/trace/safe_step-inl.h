// The steps that the bounds allow along a vector of rays. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_SAFE_STEP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_SAFE_STEP_INL_H_
#undef STRATA_TRACE_SAFE_STEP_INL_H_
#else
#define STRATA_TRACE_SAFE_STEP_INL_H_
#endif

#include "src/trace/evaluation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// The longest step that is certified to stay outside the surface.
template <bool kWindows>
HWY_INLINE FloatVec safe_step(const TracePlan& plan, const Packet& packet, const Evaluation& at, FloatVec delta,
                              const OctaveCache& cache) {
    const FloatTag d;
    const FloatVec speed = hn::Load(d, packet.speed), hint = hn::Min(hn::Load(d, packet.hint), at.room);
    const FloatVec certain = hn::Sub(at.f, hn::Add(at.rest, at.error));
    const FloatVec slope = hn::Sub(at.base_slope, hn::Set(d, plan.slope_error));
    const auto solve = [&](const OctaveBounds& bounds, FloatVec step) HWY_ATTR {
        const FloatVec root =
            first_root(hn::Sub(certain, bounds.drop), hn::MulAdd(slope, step, bounds.slope), bounds.bend);
        return hn::Mul(root, step);
    };
    // The global Lipschitz step is where to look again when the hint was so far off that it gave no step.
    const FloatVec first = solve(at.bounds, hint);
    const FloatVec least = hn::Mul(hn::Max(certain, hn::Zero(d)), hn::Set(d, plan.inverse_lipschitz));
    const FloatVec again = hn::Min(hn::Max(hn::Max(first, delta), least), hn::Min(at.room, hn::Set(d, 1e15f)));
    const FloatVec span = hn::Mul(again, speed);
    OctaveBounds bounds = window_bounds<kWindows>(at, again);
    for (std::size_t k = 0; k < cache.count; ++k) {
        const TraceOctave& octave = plan.octaves[k];
        // The span first: a vertical ray's speed of 0 must not meet an infinite product.
        const FloatVec wave = hn::Set(d, octave.wave);
        bounds = add_octave(bounds, plan, octave, cache.value[k], cache.slope[k], hn::Mul(wave, again),
                            hn::Mul(wave, span), uses_octave(at, k));
    }
    return hn::Min(hn::Max(first, solve(bounds, again)), at.room);
}

// Lanes whose stretch of length packet.over behind them is free, by bounds taken backwards. f is at least a concave
// parabola there, so it is positive in between where it is at both ends.
template <bool kWindows>
HWY_INLINE hn::Mask<FloatTag> covers_overstep(const TracePlan& plan, const Packet& packet, const Evaluation& at,
                                              const OctaveCache& cache) {
    const FloatTag d;
    const FloatVec over = hn::Load(d, packet.over), span = hn::Mul(over, hn::Load(d, packet.speed));
    const auto lands = hn::Le(over, hn::Zero(d));
    if (HWY_LIKELY(hn::AllTrue(d, lands))) return lands;
    OctaveBounds bounds = window_bounds<kWindows>(at, over);
    for (std::size_t k = 0; k < cache.count; ++k) {
        const FloatVec wave = hn::Set(d, plan.octaves[k].wave);
        bounds = add_octave(bounds, plan, plan.octaves[k], cache.value[k], hn::Neg(cache.slope[k]), hn::Mul(wave, over),
                            hn::Mul(wave, span), uses_octave(at, k));
    }
    const FloatVec here = hn::Sub(hn::Sub(at.f, hn::Add(at.rest, at.error)), bounds.drop);
    const FloatVec base_slope = hn::Add(at.base_slope, hn::Set(d, plan.slope_error));
    const FloatVec climb = hn::NegMulAdd(base_slope, over, bounds.slope);
    // What is added up here has been rounded a few times.
    const FloatVec size = hn::Add(here, hn::Add(hn::Abs(climb), bounds.bend));
    const FloatVec there = hn::Sub(hn::Add(here, climb), bounds.bend);
    const auto is_free = hn::And(hn::Gt(here, hn::Zero(d)),
                                 hn::Gt(there, hn::Mul(size, hn::Set(d, static_cast<float>(kRoundUp - 1.0)))));
    return hn::Or(lands, is_free);
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
