// One octave of the field at a vector of points. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_OCTAVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_OCTAVE_INL_H_
#undef STRATA_TRACE_OCTAVE_INL_H_
#else
#define STRATA_TRACE_OCTAVE_INL_H_
#endif

#include <type_traits>

#include "noise/relief/relief.h"
#include "src/trace/field.h"
#include "src/trace/trace_plan.h"
#include "src/trace/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

namespace simd_noise = strata::noise::HWY_NAMESPACE;

// Cells within this distance of the origin share one block of the hash, with room for the cell above.
inline constexpr double kNearCells = 0x1p30;

// The one choice that the kernels are compiled twice for: calls `f` with std::true_type where the field's noise is 2-D,
// else with std::false_type.
template <class F>
HWY_INLINE auto by_dimensions(const Field& field, const F& f) {
    if (field.is_planar_noise()) return f(std::true_type());
    return f(std::false_type());
}

struct OctaveSample {
    FloatVec value, dx, dy, dz;  // of n; derivatives in lattice units
};

struct AxisSample {
    simd_noise::Planes planes;
    FloatVec fraction;
};

template <bool kNear>
HWY_INLINE AxisSample locate(const TraceOctave& octave, std::size_t noise_axis, const Wide& x) {
    const Wide p = mul_add(x, octave.frequency, octave.offset[noise_axis]);
    const Wide cell = floor(p);
    const FloatVec fraction = to_float(sub(p, cell));
    const CellWords words = cell_words(cell);
    if constexpr (kNear) {
        return {simd_noise::planes(low_word(words), hn::Set(WordTag(), octave.near_block[noise_axis])), fraction};
    }
    return {simd_noise::planes_wide(low_word(words), high_word(words), octave.key[noise_axis]), fraction};
}

struct WidePoint {
    Wide x, y, z;
};

template <bool kPlanar, bool kNear>
HWY_INLINE OctaveSample sample_octave(const TraceOctave& octave, const WidePoint& at) {
    if constexpr (kPlanar) {
        const AxisSample x = locate<kNear>(octave, 0, at.x), z = locate<kNear>(octave, 1, at.z);
        const simd_noise::Jet2 jet = simd_noise::noise2(x.planes, z.planes, x.fraction, z.fraction);
        return {jet.value, jet.dx, hn::Zero(FloatTag()), jet.dy};
    } else {
        const AxisSample x = locate<kNear>(octave, 0, at.x), y = locate<kNear>(octave, 1, at.y);
        const AxisSample z = locate<kNear>(octave, 2, at.z);
        const simd_noise::Jet3 jet =
            simd_noise::noise3(x.planes, y.planes, z.planes, x.fraction, y.fraction, z.fraction);
        return {jet.value, jet.dx, jet.dy, jet.dz};
    }
}

// reach: bound of |x| on every axis of every lane. Both paths give the same bits where both apply.
template <bool kPlanar>
HWY_INLINE OctaveSample sample_octave(const TraceOctave& octave, const WidePoint& at, double reach) {
    if (HWY_LIKELY(octave.frequency * reach + 2.0 < kNearCells)) return sample_octave<kPlanar, true>(octave, at);
    return sample_octave<kPlanar, false>(octave, at);
}

// The octave on a lattice that is turned about y, with its derivatives turned back.
template <bool kPlanar>
HWY_INLINE OctaveSample sample_turned(const TraceOctave& octave, const noise::PlanTurn& turn, const WidePoint& at,
                                      double reach) {
    const DoubleVec c = hn::Set(DoubleTag(), turn.cosine), s = hn::Set(DoubleTag(), turn.sine);
    const auto along = [&](auto x, auto z) HWY_ATTR { return hn::MulAdd(c, x, hn::Mul(s, z)); };
    const auto across = [&](auto x, auto z) HWY_ATTR { return hn::NegMulAdd(s, x, hn::Mul(c, z)); };
    const WidePoint there{each_part(along, at.x, at.z), at.y, each_part(across, at.x, at.z)};
    const OctaveSample n = sample_octave<kPlanar>(octave, there, 1.4143 * reach);
    const FloatTag d;
    const FloatVec cosine = hn::Set(d, static_cast<float>(turn.cosine));
    const FloatVec sine = hn::Set(d, static_cast<float>(turn.sine));
    return {n.value, hn::MulSub(cosine, n.dx, hn::Mul(sine, n.dz)), n.dy,
            hn::MulAdd(sine, n.dx, hn::Mul(cosine, n.dz))};
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
