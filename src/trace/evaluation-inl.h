// f and what bounds it around a vector of rays' points. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_EVALUATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_EVALUATION_INL_H_
#undef STRATA_TRACE_EVALUATION_INL_H_
#else
#define STRATA_TRACE_EVALUATION_INL_H_
#endif

#include <array>

#include "src/trace/base-inl.h"
#include "src/trace/lower_bound-inl.h"
#include "src/trace/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// An octave is evaluated where the hinted step is below this many of its lattice cells: beyond, its amplitude bound is
// the least anyway. Speed only; measured minimum of evaluations a ray, flat from 0.2 to 0.4.
constexpr float kCellsAhead = 0.3f;

// What one step learns of every lane.
struct Evaluation {
    FloatVec f;      // base minus the evaluated octaves
    FloatVec error;  // of f
    FloatVec slope;  // of f along the ray; of use where none is missing
    FloatVec base_slope;
    FloatPoint gradient;  // of the evaluated octaves, of f's sign
    FloatVec rest;        // bound of the octaves not evaluated
    OctaveBounds bounds;
    hn::Mask<FloatTag> complete;  // all octaves were evaluated
    hn::Mask<FloatTag> inside;    // f < 0 whatever the octaves not evaluated
    WordVec octaves;              // how many were
    hn::Mask<FloatTag> windowed;  // a window stands for all octaves
    FloatVec bend;                // half the second derivative along the ray there, or 0
    FloatVec room;                // to the window's end
};

struct OctaveCache {
    std::array<FloatVec, noise::kMaxOctaves> value, slope;
    std::size_t count = 0;
};

template <bool kWindows>
HWY_INLINE OctaveBounds window_bounds(const Evaluation& at, FloatVec step) {
    OctaveBounds bounds = no_bounds();
    if constexpr (kWindows) bounds.bend = hn::Mul(at.bend, hn::Mul(step, step));
    return bounds;
}

// The base and the windows' part of f.
template <bool kPlanar, bool kWindows>
HWY_INLINE Evaluation without_octaves(const TracePlan& plan, const Field& field, const Packet& packet,
                                      const WidePoint& x, const WidePoint& noise_x, const WidePoint& direction) {
    const FloatTag d;
    const Base base = base_at<kPlanar>(field, x, direction);
    Evaluation at;
    at.f = base.value;
    at.error = hn::MulAdd(hn::Abs(base.value), hn::Set(d, plan.error_relative), hn::Set(d, plan.error_absolute));
    at.slope = at.base_slope = base.slope;
    at.gradient = base_gradient_at<kPlanar>(field, x);
    at.rest = at.bend = hn::Zero(d);
    at.windowed = hn::Lt(at.bend, at.bend);  // none
    at.octaves = hn::Zero(WordTag());
    at.room = hn::Set(d, 1e30f);
    if constexpr (kWindows) {
        const WindowPart part = window_part(packet.windows, noise_x, to_float(direction));
        at.f = hn::Sub(at.f, part.value);
        at.error = hn::Add(at.error, part.error);
        at.slope = at.base_slope = hn::Sub(base.slope, part.slope);
        at.windowed = hn::Gt(part.error, hn::Zero(d));
        at.bend = hn::Max(part.bend, hn::Zero(d));
        const FloatVec room = to_float(sub(load_wide(packet.windows.exit), load_wide(packet.s)));
        at.room = hn::Min(hn::Max(room, hn::Zero(d)), at.room);
    }
    return at;
}

// x is where the ray is; the noise is evaluated elsewhere when it drifts.
template <bool kPlanar, bool kWindows>
HWY_INLINE Evaluation evaluate(const TracePlan& plan, const Field& field, const Packet& packet, const WidePoint& x,
                               const WidePoint& direction, OctaveCache& cache, TraceCounters& counters) {
    const FloatTag d;
    const WordTag dw;
    const FloatPoint along = to_float(direction);
    WidePoint noise_x = x;
    if (field.drifts()) noise_x = add(x, load_point(packet.noise_shift));
    Evaluation at = without_octaves<kPlanar, kWindows>(plan, field, packet, x, noise_x, direction);
    const FloatVec hint = hn::Min(hn::Load(d, packet.hint), at.room), span = hn::Mul(hint, hn::Load(d, packet.speed));
    at.bounds = window_bounds<kWindows>(at, hint);
    auto open = hn::Gt(hn::Load(d, packet.active), hn::Zero(d));
    at.inside = hn::Lt(hn::Zero(d), hn::Zero(d));
    if constexpr (kWindows) open = hn::AndNot(at.windowed, open);
    cache.count = 0;
    for (const TraceOctave& octave : plan.octaves) {
        // Stop where f is negative whatever the rest, or positive and the octave is too fine for the step to gain by
        // it.
        const FloatVec rest = hn::Set(d, octave.rest), wave = hn::Set(d, octave.wave);
        const FloatVec ws = hn::Mul(wave, span);
        const auto doubtful = hn::Le(hn::Sub(at.f, rest), at.error);
        const auto certain = hn::And(open, hn::Lt(hn::Add(at.f, rest), hn::Neg(at.error)));
        const auto wanted = hn::AndNot(certain, hn::And(open, hn::Or(doubtful, hn::Le(ws, hn::Set(d, kCellsAhead)))));
        at.inside = hn::Or(at.inside, certain);
        at.rest = hn::IfThenElse(hn::AndNot(wanted, open), rest, at.rest);
        open = wanted;
        if (hn::AllFalse(d, open)) break;
        const OctaveSample n = sample_octave<kPlanar>(octave, noise_x, packet.reach);
        FloatVec slope = hn::MulAdd(n.dx, along.x, hn::Mul(n.dz, along.z));
        if constexpr (!kPlanar) slope = hn::MulAdd(n.dy, along.y, slope);
        const FloatVec amplitude = hn::IfThenElseZero(open, hn::Set(d, octave.amplitude));
        at.f = hn::NegMulAdd(amplitude, n.value, at.f);
        const FloatVec pull = hn::Mul(amplitude, wave);
        at.slope = hn::NegMulAdd(pull, slope, at.slope);
        at.gradient.x = hn::NegMulAdd(pull, n.dx, at.gradient.x);
        if constexpr (!kPlanar) at.gradient.y = hn::NegMulAdd(pull, n.dy, at.gradient.y);
        at.gradient.z = hn::NegMulAdd(pull, n.dz, at.gradient.z);
        at.bounds = add_octave(at.bounds, plan, octave, n.value, slope, hn::Mul(wave, hint), ws, open);
        at.octaves = hn::Add(at.octaves, hn::IfThenElseZero(hn::RebindMask(dw, open), hn::Set(dw, 1u)));
        cache.value[cache.count] = n.value;
        cache.slope[cache.count++] = slope;
        counters.noise_evaluations += hn::CountTrue(d, open);
        counters.executed_lanes += hn::Lanes(d);
    }
    at.complete = open;
    return at;
}

HWY_INLINE hn::Mask<FloatTag> uses_octave(const Evaluation& at, std::size_t k) {
    const hn::RebindToSigned<FloatTag> d;
    return hn::RebindMask(FloatTag(), hn::Gt(hn::BitCast(d, at.octaves), hn::Set(d, static_cast<int>(k))));
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
