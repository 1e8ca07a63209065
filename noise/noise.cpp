#include "noise/noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/noise.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "noise/noise-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

// One axis of a batch: the base cell's words, and whether every |offset| < 2^24 stays in the base cell's block.
struct BaseAxis {
    std::uint32_t lo, hi, key, block;
    bool narrow;

    BaseAxis(std::int64_t cell, std::uint32_t axis_key)
        : lo(static_cast<std::uint32_t>(static_cast<std::uint64_t>(cell) + kCellBias)),
          hi(static_cast<std::uint32_t>((static_cast<std::uint64_t>(cell) + kCellBias) >> 32)),
          key(axis_key),
          block(mix32(hi ^ axis_key)),
          narrow(lo - (1u << 24) < 0xFE000000u) {}
};

struct AxisPoint {
    Planes planes;
    FloatVec fraction;
};

// offset in cells from the base cell's lower corner.
template <bool kNarrow>
HWY_INLINE AxisPoint locate(const BaseAxis& base, FloatVec offset) {
    const WordTag d;
    const FloatVec floor = hn::Floor(offset);
    const WordVec step = hn::BitCast(d, hn::ConvertTo(IndexTag(), floor));
    const WordVec lo = hn::Add(hn::Set(d, base.lo), step);
    const FloatVec fraction = hn::Sub(offset, floor);
    if constexpr (kNarrow) return {planes(lo, hn::Set(d, base.block)), fraction};
    const auto backward = hn::Gt(hn::BitCast(IndexTag(), hn::ShiftRight<31>(step)), hn::Zero(IndexTag()));
    const WordVec zero = hn::Zero(d), base_lo = hn::Set(d, base.lo);
    const auto wrapped_up = hn::Ne(hn::Max(lo, base_lo), lo);    // lo < base.lo
    const auto wrapped_down = hn::Ne(hn::Min(lo, base_lo), lo);  // lo > base.lo
    const WordVec up = hn::IfThenElse(hn::RebindMask(d, wrapped_up), hn::Set(d, 1u), zero);
    const WordVec down = hn::IfThenElse(hn::RebindMask(d, wrapped_down), hn::Set(d, ~0u), zero);
    const WordVec carry = hn::IfThenElse(hn::RebindMask(d, backward), down, up);
    return {planes_wide(lo, hn::Add(hn::Set(d, base.hi), carry), base.key), fraction};
}

// Applies body(i, n) to [0, count) in steps of a vector; n < Lanes only for the last.
template <class Body>
HWY_INLINE void for_vectors(std::size_t count, const Body& body) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) body(i, lanes);
    if (i < count) body(i, count - i);
}

HWY_INLINE FloatVec load(std::span<const float> from, std::size_t i, std::size_t n) {
    const FloatTag d;
    if (HWY_LIKELY(n == hn::Lanes(d))) return hn::LoadU(d, from.data() + i);
    HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)] = {};
    std::copy_n(from.data() + i, n, lanes);
    return hn::Load(d, lanes);
}

HWY_INLINE void store(FloatVec v, std::span<float> to, std::size_t i, std::size_t n) {
    const FloatTag d;
    if (HWY_LIKELY(n == hn::Lanes(d))) return hn::StoreU(v, d, to.data() + i);
    HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(v, d, lanes);
    std::copy_n(lanes, n, to.data() + i);
}

template <bool kNarrow, class Use>
HWY_INLINE void each_jet(const LatticeKey& key, const Points<2>& points, const Use& use) {
    const BaseAxis bx(points.base_cell[0], key.axis[0]), by(points.base_cell[1], key.axis[1]);
    for_vectors(points.offset[0].size(), [&](std::size_t i, std::size_t n) HWY_ATTR {
        const AxisPoint x = locate<kNarrow>(bx, load(points.offset[0], i, n));
        const AxisPoint y = locate<kNarrow>(by, load(points.offset[1], i, n));
        use(noise2(x.planes, y.planes, x.fraction, y.fraction), i, n);
    });
}

template <bool kNarrow, class Use>
HWY_INLINE void each_jet(const LatticeKey& key, const Points<3>& points, const Use& use) {
    const BaseAxis bx(points.base_cell[0], key.axis[0]), by(points.base_cell[1], key.axis[1]),
        bz(points.base_cell[2], key.axis[2]);
    for_vectors(points.offset[0].size(), [&](std::size_t i, std::size_t n) HWY_ATTR {
        const AxisPoint x = locate<kNarrow>(bx, load(points.offset[0], i, n));
        const AxisPoint y = locate<kNarrow>(by, load(points.offset[1], i, n));
        const AxisPoint z = locate<kNarrow>(bz, load(points.offset[2], i, n));
        use(noise3(x.planes, y.planes, z.planes, x.fraction, y.fraction, z.fraction), i, n);
    });
}

template <std::size_t D, class Use>
HWY_INLINE void dispatch_width(const LatticeKey& key, const Points<D>& points, const Use& use) {
    bool narrow = true;
    for (std::size_t axis = 0; axis < D; ++axis) {
        narrow = narrow && BaseAxis(points.base_cell[axis], key.axis[axis]).narrow;
    }
    if (HWY_LIKELY(narrow)) return each_jet<true>(key, points, use);
    each_jet<false>(key, points, use);
}

template <std::size_t D>
HWY_INLINE void value_batch(const LatticeKey& key, const Points<D>& points, std::span<float> value) {
    dispatch_width(key, points,
                   [&](const auto& jet, std::size_t i, std::size_t n) HWY_ATTR { store(jet.value, value, i, n); });
}

HWY_INLINE void store_gradient(const Jet2& jet, const GradientSpans<2>& to, std::size_t i, std::size_t n) {
    store(jet.dx, to.axis[0], i, n);
    store(jet.dy, to.axis[1], i, n);
}

HWY_INLINE void store_gradient(const Jet3& jet, const GradientSpans<3>& to, std::size_t i, std::size_t n) {
    store(jet.dx, to.axis[0], i, n);
    store(jet.dy, to.axis[1], i, n);
    store(jet.dz, to.axis[2], i, n);
}

HWY_INLINE void store_hessian(const Jet2& jet, const HessianSpans<2>& to, std::size_t i, std::size_t n) {
    store(jet.dxx, to.entry[0], i, n);
    store(jet.dxy, to.entry[1], i, n);
    store(jet.dyy, to.entry[2], i, n);
}

HWY_INLINE void store_hessian(const Jet3& jet, const HessianSpans<3>& to, std::size_t i, std::size_t n) {
    store(jet.dxx, to.entry[0], i, n);
    store(jet.dyy, to.entry[1], i, n);
    store(jet.dzz, to.entry[2], i, n);
    store(jet.dxy, to.entry[3], i, n);
    store(jet.dxz, to.entry[4], i, n);
    store(jet.dyz, to.entry[5], i, n);
}

template <std::size_t D>
HWY_INLINE void gradient_batch(const LatticeKey& key, const Points<D>& points, std::span<float> value,
                               const GradientSpans<D>& gradient) {
    dispatch_width(key, points, [&](const auto& jet, std::size_t i, std::size_t n) HWY_ATTR {
        store(jet.value, value, i, n);
        store_gradient(jet, gradient, i, n);
    });
}

template <std::size_t D>
HWY_INLINE void hessian_batch(const LatticeKey& key, const Points<D>& points, std::span<float> value,
                              const GradientSpans<D>& gradient, const HessianSpans<D>& hessian) {
    dispatch_width(key, points, [&](const auto& jet, std::size_t i, std::size_t n) HWY_ATTR {
        store(jet.value, value, i, n);
        store_gradient(jet, gradient, i, n);
        store_hessian(jet, hessian, i, n);
    });
}

// The octave's position at a batch's origin, split into cell and fraction.
template <std::size_t D>
struct OctaveBase {
    std::array<BaseAxis, D> axis;
    std::array<float, D> fraction;
    float frequency, amplitude;
    bool narrow;
};

template <std::size_t D, std::size_t... kAxes>
OctaveBase<D> split(const Octave& octave, const std::array<double, D>& origin, std::index_sequence<kAxes...>) {
    std::array<double, D> floor;
    std::array<float, D> fraction;
    for (std::size_t a = 0; a < D; ++a) {
        const double p = octave.frequency * origin[a] + octave.offset[a];
        floor[a] = std::floor(p);
        fraction[a] = static_cast<float>(p - floor[a]);
    }
    const std::array<BaseAxis, D> axes = {BaseAxis(static_cast<std::int64_t>(floor[kAxes]), octave.key.axis[kAxes])...};
    bool narrow = true;
    for (const BaseAxis& axis : axes) narrow = narrow && axis.narrow;
    return {axes, fraction, static_cast<float>(octave.frequency), static_cast<float>(octave.amplitude), narrow};
}

template <bool kNarrow>
HWY_INLINE FloatVec octave_value(const OctaveBase<2>& base, const std::array<FloatVec, 2>& offset) {
    const FloatTag d;
    const FloatVec w = hn::Set(d, base.frequency);
    const AxisPoint x = locate<kNarrow>(base.axis[0], hn::MulAdd(w, offset[0], hn::Set(d, base.fraction[0])));
    const AxisPoint y = locate<kNarrow>(base.axis[1], hn::MulAdd(w, offset[1], hn::Set(d, base.fraction[1])));
    return noise2(x.planes, y.planes, x.fraction, y.fraction).value;
}

template <bool kNarrow>
HWY_INLINE FloatVec octave_value(const OctaveBase<3>& base, const std::array<FloatVec, 3>& offset) {
    const FloatTag d;
    const FloatVec w = hn::Set(d, base.frequency);
    const AxisPoint x = locate<kNarrow>(base.axis[0], hn::MulAdd(w, offset[0], hn::Set(d, base.fraction[0])));
    const AxisPoint y = locate<kNarrow>(base.axis[1], hn::MulAdd(w, offset[1], hn::Set(d, base.fraction[1])));
    const AxisPoint z = locate<kNarrow>(base.axis[2], hn::MulAdd(w, offset[2], hn::Set(d, base.fraction[2])));
    return noise3(x.planes, y.planes, z.planes, x.fraction, y.fraction, z.fraction).value;
}

template <std::size_t D>
HWY_INLINE void fbm_batch(std::span<const Octave> octaves, const std::array<double, D>& origin,
                          const std::array<std::span<const float>, D>& offset, std::span<float> value) {
    for_vectors(value.size(), [&](std::size_t i, std::size_t n) HWY_ATTR { store(hn::Zero(FloatTag()), value, i, n); });
    for (const Octave& octave : octaves) {
        const OctaveBase<D> base = split(octave, origin, std::make_index_sequence<D>());
        const FloatVec amplitude = hn::Set(FloatTag(), base.amplitude);
        for_vectors(value.size(), [&](std::size_t i, std::size_t n) HWY_ATTR {
            std::array<FloatVec, D> at;
            for (std::size_t a = 0; a < D; ++a) at[a] = load(offset[a], i, n);
            const FloatVec v = base.narrow ? octave_value<true>(base, at) : octave_value<false>(base, at);
            store(hn::MulAdd(amplitude, v, load(value, i, n)), value, i, n);
        });
    }
}

void Value2(const LatticeKey& k, const Points<2>& p, std::span<float> v) { value_batch(k, p, v); }
void Value3(const LatticeKey& k, const Points<3>& p, std::span<float> v) { value_batch(k, p, v); }
void Gradient2(const LatticeKey& k, const Points<2>& p, std::span<float> v, const GradientSpans<2>& g) {
    gradient_batch(k, p, v, g);
}
void Gradient3(const LatticeKey& k, const Points<3>& p, std::span<float> v, const GradientSpans<3>& g) {
    gradient_batch(k, p, v, g);
}
void Hessian2(const LatticeKey& k, const Points<2>& p, std::span<float> v, const GradientSpans<2>& g,
              const HessianSpans<2>& h) {
    hessian_batch(k, p, v, g, h);
}
void Hessian3(const LatticeKey& k, const Points<3>& p, std::span<float> v, const GradientSpans<3>& g,
              const HessianSpans<3>& h) {
    hessian_batch(k, p, v, g, h);
}
void Fbm2(std::span<const Octave> o, const std::array<double, 2>& x, const std::array<std::span<const float>, 2>& d,
          std::span<float> v) {
    fbm_batch<2>(o, x, d, v);
}
void Fbm3(std::span<const Octave> o, const std::array<double, 3>& x, const std::array<std::span<const float>, 3>& d,
          std::span<float> v) {
    fbm_batch<3>(o, x, d, v);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::noise {

HWY_EXPORT(Value2);
HWY_EXPORT(Value3);
HWY_EXPORT(Gradient2);
HWY_EXPORT(Gradient3);
HWY_EXPORT(Hessian2);
HWY_EXPORT(Hessian3);
HWY_EXPORT(Fbm2);
HWY_EXPORT(Fbm3);

void noise_value(const LatticeKey& key, const Points<2>& points, std::span<float> value) {
    HWY_DYNAMIC_DISPATCH(Value2)(key, points, value);
}
void noise_value(const LatticeKey& key, const Points<3>& points, std::span<float> value) {
    HWY_DYNAMIC_DISPATCH(Value3)(key, points, value);
}
void noise_gradient(const LatticeKey& key, const Points<2>& points, std::span<float> value,
                    const GradientSpans<2>& gradient) {
    HWY_DYNAMIC_DISPATCH(Gradient2)(key, points, value, gradient);
}
void noise_gradient(const LatticeKey& key, const Points<3>& points, std::span<float> value,
                    const GradientSpans<3>& gradient) {
    HWY_DYNAMIC_DISPATCH(Gradient3)(key, points, value, gradient);
}
void noise_hessian(const LatticeKey& key, const Points<2>& points, std::span<float> value,
                   const GradientSpans<2>& gradient, const HessianSpans<2>& hessian) {
    HWY_DYNAMIC_DISPATCH(Hessian2)(key, points, value, gradient, hessian);
}
void noise_hessian(const LatticeKey& key, const Points<3>& points, std::span<float> value,
                   const GradientSpans<3>& gradient, const HessianSpans<3>& hessian) {
    HWY_DYNAMIC_DISPATCH(Hessian3)(key, points, value, gradient, hessian);
}
void fbm_value(std::span<const Octave> octaves, const std::array<double, 2>& origin,
               const std::array<std::span<const float>, 2>& offset, std::span<float> value) {
    HWY_DYNAMIC_DISPATCH(Fbm2)(octaves, origin, offset, value);
}
void fbm_value(std::span<const Octave> octaves, const std::array<double, 3>& origin,
               const std::array<std::span<const float>, 3>& offset, std::span<float> value) {
    HWY_DYNAMIC_DISPATCH(Fbm3)(octaves, origin, offset, value);
}

}  // namespace strata::noise
#endif  // HWY_ONCE
