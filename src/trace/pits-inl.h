// Craters (noise/relief/pits.h) around a vector of points. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_PITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_PITS_INL_H_
#undef STRATA_TRACE_PITS_INL_H_
#else
#define STRATA_TRACE_PITS_INL_H_
#endif

#include "noise/relief/pits.h"
#include "src/trace/octave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// The cell of each point.
struct Corners {
    AxisSample x, z;
};

// One of its craters: the way from its middle to the point, in cells, and its shape.
struct PitSample {
    FloatVec x, z, radius, depth;
};

// reach: bound of |x| on every axis of every lane.
HWY_INLINE Corners corners_of(const TraceOctave& octave, const WidePoint& at, double reach) {
    if (HWY_LIKELY(octave.frequency * reach + 2.0 < kNearCells)) {
        return {locate<true>(octave, 0, at.x), locate<true>(octave, 1, at.z)};
    }
    return {locate<false>(octave, 0, at.x), locate<false>(octave, 1, at.z)};
}

template <int kShift>
HWY_INLINE FloatVec pit_byte(WordVec bits) {
    const WordVec byte = hn::And(hn::ShiftRight<kShift>(bits), hn::Set(WordTag(), 255u));
    const hn::RebindToSigned<FloatTag> integers;
    return hn::Mul(hn::ConvertTo(FloatTag(), hn::BitCast(integers, byte)),
                   hn::Set(FloatTag(), static_cast<float>(noise::kPitByte)));
}

// corner: bit 0 says right, bit 1 up.
HWY_INLINE PitSample sample_pit(const Corners& cell, unsigned corner, double worn) {
    const FloatTag d;
    const auto set = [&](double v) HWY_ATTR { return hn::Set(d, static_cast<float>(v)); };
    const bool right = (corner & 1) != 0, up = (corner & 2) != 0;
    const WordVec word =
        hn::Xor(right ? cell.x.planes.above : cell.x.planes.below, up ? cell.z.planes.above : cell.z.planes.below);
    WordVec bits = hn::Mul(word, hn::Set(WordTag(), noise::kCornerMultiplier));
    bits = hn::Mul(hn::Xor(bits, hn::ShiftRight<15>(bits)), hn::Set(WordTag(), noise::kAxisMultiplier));
    const FloatVec half = set(0.5), quarter = set(0.25), one = set(1.0);
    const FloatVec x = right ? hn::Sub(cell.x.fraction, one) : cell.x.fraction;
    const FloatVec z = up ? hn::Sub(cell.z.fraction, one) : cell.z.fraction;
    const FloatVec size = pit_byte<16>(bits), age = pit_byte<24>(bits);
    return {hn::Sub(x, hn::Sub(hn::Mul(half, pit_byte<0>(bits)), quarter)),
            hn::Sub(z, hn::Sub(hn::Mul(half, pit_byte<8>(bits)), quarter)),
            hn::MulAdd(hn::Mul(size, size), set(noise::kWidest - noise::kNarrowest), set(noise::kNarrowest)),
            hn::MulAdd(hn::Mul(age, age), set(1.0 - worn), set(worn))};
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
