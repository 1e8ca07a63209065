// One stripe (noise/relief/stripe.h) at a vector of points. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_STRIPE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_STRIPE_INL_H_
#undef STRATA_TRACE_STRIPE_INL_H_
#else
#define STRATA_TRACE_STRIPE_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include "noise/relief/stripe.h"
#include "src/trace/octave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// C and S with their derivatives by the place (lattice units) and by the direction.
struct StripeSample {
    FloatVec c, c_x, c_z, c_dx, c_dz;
    FloatVec s, s_x, s_z, s_dx, s_dz;
};

struct TurnedCorner {
    FloatVec cosine, sine;
};

// exp(2 pi i turns), |turns| below 2^20: off by a few 2^-24.
HWY_INLINE TurnedCorner turned_by(FloatVec turns) {
    const FloatTag d;
    const FloatVec angle = hn::Mul(hn::Sub(turns, hn::Round(turns)), hn::Set(d, 6.2831853f));
    return {hn::Cos(d, angle), hn::Sin(d, angle)};
}

HWY_INLINE FloatVec phase_of(WordVec word) {
    const WordVec bits =
        hn::ShiftRight<noise::kPhaseShift>(hn::Mul(word, hn::Set(WordTag(), noise::kCornerMultiplier)));
    const hn::RebindToSigned<FloatTag> integers;
    return hn::Mul(hn::ConvertTo(FloatTag(), hn::BitCast(integers, bits)),
                   hn::Set(FloatTag(), static_cast<float>(noise::kPhaseUnit)));
}

template <bool kNear>
HWY_INLINE StripeSample sample_stripe_at(const TraceOctave& octave, const WidePoint& at, FloatVec dx, FloatVec dz,
                                         double bands) {
    const FloatTag d;
    const AxisSample x = locate<kNear>(octave, 0, at.x), z = locate<kNear>(octave, 1, at.z);
    const simd_noise::Fade fade_x = simd_noise::fade_of(x.fraction), fade_z = simd_noise::fade_of(z.fraction);
    const FloatVec one = hn::Set(d, 1.0f), zero = hn::Zero(d);
    const FloatVec u = simd_noise::fade(fade_x), v = simd_noise::fade(fade_z);
    const FloatVec du = simd_noise::fade_derivative(fade_x), dv = simd_noise::fade_derivative(fade_z);
    const FloatVec side = hn::Set(d, static_cast<float>(bands));
    const FloatVec wave = hn::Set(d, static_cast<float>(noise::StripeBounds(bands).wave));
    StripeSample sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    for (unsigned corner = 0; corner < 4; ++corner) {
        const bool right = (corner & 1) != 0, up = (corner & 2) != 0;
        const FloatVec tx = right ? hn::Sub(x.fraction, one) : x.fraction;
        const FloatVec tz = up ? hn::Sub(z.fraction, one) : z.fraction;
        const WordVec word = hn::Xor(right ? x.planes.above : x.planes.below, up ? z.planes.above : z.planes.below);
        const FloatVec along = hn::MulAdd(dx, tx, hn::Mul(dz, tz));
        const TurnedCorner e = turned_by(hn::MulAdd(side, along, phase_of(word)));
        const FloatVec wx = right ? u : hn::Sub(one, u), wz = up ? v : hn::Sub(one, v), w = hn::Mul(wx, wz);
        const FloatVec w_x = hn::Mul(right ? du : hn::Neg(du), wz), w_z = hn::Mul(up ? dv : hn::Neg(dv), wx);
        const FloatVec turn_c = hn::Neg(hn::Mul(hn::Mul(w, wave), e.sine)),
                       turn_s = hn::Mul(hn::Mul(w, wave), e.cosine);
        sum.c = hn::MulAdd(w, e.cosine, sum.c);
        sum.s = hn::MulAdd(w, e.sine, sum.s);
        sum.c_x = hn::Add(sum.c_x, hn::MulAdd(w_x, e.cosine, hn::Mul(turn_c, dx)));
        sum.c_z = hn::Add(sum.c_z, hn::MulAdd(w_z, e.cosine, hn::Mul(turn_c, dz)));
        sum.s_x = hn::Add(sum.s_x, hn::MulAdd(w_x, e.sine, hn::Mul(turn_s, dx)));
        sum.s_z = hn::Add(sum.s_z, hn::MulAdd(w_z, e.sine, hn::Mul(turn_s, dz)));
        sum.c_dx = hn::MulAdd(turn_c, tx, sum.c_dx);
        sum.c_dz = hn::MulAdd(turn_c, tz, sum.c_dz);
        sum.s_dx = hn::MulAdd(turn_s, tx, sum.s_dx);
        sum.s_dz = hn::MulAdd(turn_s, tz, sum.s_dz);
    }
    return sum;
}

// reach: bound of |x| on every axis of every lane.
HWY_INLINE StripeSample sample_stripe(const TraceOctave& octave, const WidePoint& at, double reach, FloatVec dx,
                                      FloatVec dz, double bands) {
    if (HWY_LIKELY(octave.frequency * reach + 2.0 < kNearCells))
        return sample_stripe_at<true>(octave, at, dx, dz, bands);
    return sample_stripe_at<false>(octave, at, dx, dz, bands);
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
