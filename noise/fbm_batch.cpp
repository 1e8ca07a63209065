#include <cmath>
#include <utility>

#include "noise/noise.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/fbm_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "noise/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

// The octave's position at a batch's origin, split into cell and fraction, and what its derivatives are multiplied by.
template <std::size_t D>
struct OctaveBase {
    std::array<BaseAxis, D> axis;
    std::array<float, D> fraction;
    float frequency;
    std::array<float, 3> amplitude;  // of derivatives of order 0, 1 and 2
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
    const double slope = octave.amplitude * octave.frequency;
    return {
        axes,
        fraction,
        static_cast<float>(octave.frequency),
        {static_cast<float>(octave.amplitude), static_cast<float>(slope), static_cast<float>(slope * octave.frequency)},
        narrow};
}

template <bool kNarrow>
HWY_INLINE Jet2 octave_jet(const OctaveBase<2>& base, const std::array<FloatVec, 2>& offset) {
    const FloatTag d;
    const FloatVec w = hn::Set(d, base.frequency);
    const AxisPoint x = locate<kNarrow>(base.axis[0], hn::MulAdd(w, offset[0], hn::Set(d, base.fraction[0])));
    const AxisPoint y = locate<kNarrow>(base.axis[1], hn::MulAdd(w, offset[1], hn::Set(d, base.fraction[1])));
    return noise2(x.planes, y.planes, x.fraction, y.fraction);
}

template <bool kNarrow>
HWY_INLINE Jet3 octave_jet(const OctaveBase<3>& base, const std::array<FloatVec, 3>& offset) {
    const FloatTag d;
    const FloatVec w = hn::Set(d, base.frequency);
    const AxisPoint x = locate<kNarrow>(base.axis[0], hn::MulAdd(w, offset[0], hn::Set(d, base.fraction[0])));
    const AxisPoint y = locate<kNarrow>(base.axis[1], hn::MulAdd(w, offset[1], hn::Set(d, base.fraction[1])));
    const AxisPoint z = locate<kNarrow>(base.axis[2], hn::MulAdd(w, offset[2], hn::Set(d, base.fraction[2])));
    return noise3(x.planes, y.planes, z.planes, x.fraction, y.fraction, z.fraction);
}

HWY_INLINE std::array<FloatVec, 2> gradient_of(const Jet2& jet) { return {jet.dx, jet.dy}; }
HWY_INLINE std::array<FloatVec, 3> gradient_of(const Jet3& jet) { return {jet.dx, jet.dy, jet.dz}; }
HWY_INLINE std::array<FloatVec, 3> hessian_of(const Jet2& jet) { return {jet.dxx, jet.dxy, jet.dyy}; }
HWY_INLINE std::array<FloatVec, 6> hessian_of(const Jet3& jet) {
    return {jet.dxx, jet.dyy, jet.dzz, jet.dxy, jet.dxz, jet.dyz};
}

HWY_INLINE void add(float scale, FloatVec v, std::span<float> to, std::size_t i, std::size_t n) {
    store(hn::MulAdd(hn::Set(FloatTag(), scale), v, load(to, i, n)), to, i, n);
}

// Where the sum goes: of no derivatives, of first ones, or of second ones too.
template <std::size_t D, int kOrder>
struct Sum {
    std::span<float> value;
    const GradientSpans<D>* gradient = nullptr;
    const HessianSpans<D>* hessian = nullptr;

    HWY_INLINE void clear() const {
        for_vectors(value.size(), [&](std::size_t i, std::size_t n) HWY_ATTR {
            const FloatVec zero = hn::Zero(FloatTag());
            store(zero, value, i, n);
            if constexpr (kOrder >= 1) {
                for (std::size_t a = 0; a < D; ++a) store(zero, gradient->axis[a], i, n);
            }
            if constexpr (kOrder >= 2) {
                for (std::size_t e = 0; e < hessian->entry.size(); ++e) store(zero, hessian->entry[e], i, n);
            }
        });
    }

    template <class Jet>
    HWY_INLINE void add_jet(const std::array<float, 3>& amplitude, const Jet& jet, std::size_t i, std::size_t n) const {
        add(amplitude[0], jet.value, value, i, n);
        if constexpr (kOrder >= 1) {
            const auto slopes = gradient_of(jet);
            for (std::size_t a = 0; a < D; ++a) add(amplitude[1], slopes[a], gradient->axis[a], i, n);
        }
        if constexpr (kOrder >= 2) {
            const auto entries = hessian_of(jet);
            for (std::size_t e = 0; e < entries.size(); ++e) add(amplitude[2], entries[e], hessian->entry[e], i, n);
        }
    }
};

template <std::size_t D, int kOrder>
HWY_INLINE void fbm_batch(std::span<const Octave> octaves, const std::array<double, D>& origin,
                          const std::array<std::span<const float>, D>& offset, const Sum<D, kOrder>& sum) {
    sum.clear();
    for (const Octave& octave : octaves) {
        const OctaveBase<D> base = split(octave, origin, std::make_index_sequence<D>());
        for_vectors(sum.value.size(), [&](std::size_t i, std::size_t n) HWY_ATTR {
            std::array<FloatVec, D> at;
            for (std::size_t a = 0; a < D; ++a) at[a] = load(offset[a], i, n);
            const auto jet = base.narrow ? octave_jet<true>(base, at) : octave_jet<false>(base, at);
            sum.add_jet(base.amplitude, jet, i, n);
        });
    }
}

template <std::size_t D>
using Offsets = std::array<std::span<const float>, D>;

void Fbm2(std::span<const Octave> o, const std::array<double, 2>& x, const Offsets<2>& d, std::span<float> v) {
    fbm_batch(o, x, d, Sum<2, 0>{v});
}
void Fbm3(std::span<const Octave> o, const std::array<double, 3>& x, const Offsets<3>& d, std::span<float> v) {
    fbm_batch(o, x, d, Sum<3, 0>{v});
}
void FbmGradient2(std::span<const Octave> o, const std::array<double, 2>& x, const Offsets<2>& d, std::span<float> v,
                  const GradientSpans<2>& g) {
    fbm_batch(o, x, d, Sum<2, 1>{v, &g});
}
void FbmGradient3(std::span<const Octave> o, const std::array<double, 3>& x, const Offsets<3>& d, std::span<float> v,
                  const GradientSpans<3>& g) {
    fbm_batch(o, x, d, Sum<3, 1>{v, &g});
}
void FbmHessian2(std::span<const Octave> o, const std::array<double, 2>& x, const Offsets<2>& d, std::span<float> v,
                 const GradientSpans<2>& g, const HessianSpans<2>& h) {
    fbm_batch(o, x, d, Sum<2, 2>{v, &g, &h});
}
void FbmHessian3(std::span<const Octave> o, const std::array<double, 3>& x, const Offsets<3>& d, std::span<float> v,
                 const GradientSpans<3>& g, const HessianSpans<3>& h) {
    fbm_batch(o, x, d, Sum<3, 2>{v, &g, &h});
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::noise {

HWY_EXPORT(Fbm2);
HWY_EXPORT(Fbm3);
HWY_EXPORT(FbmGradient2);
HWY_EXPORT(FbmGradient3);
HWY_EXPORT(FbmHessian2);
HWY_EXPORT(FbmHessian3);

void fbm_value(std::span<const Octave> octaves, const std::array<double, 2>& origin,
               const std::array<std::span<const float>, 2>& offset, std::span<float> value) {
    HWY_DYNAMIC_DISPATCH(Fbm2)(octaves, origin, offset, value);
}
void fbm_value(std::span<const Octave> octaves, const std::array<double, 3>& origin,
               const std::array<std::span<const float>, 3>& offset, std::span<float> value) {
    HWY_DYNAMIC_DISPATCH(Fbm3)(octaves, origin, offset, value);
}
void fbm_gradient(std::span<const Octave> octaves, const std::array<double, 2>& origin,
                  const std::array<std::span<const float>, 2>& offset, std::span<float> value,
                  const GradientSpans<2>& gradient) {
    HWY_DYNAMIC_DISPATCH(FbmGradient2)(octaves, origin, offset, value, gradient);
}
void fbm_gradient(std::span<const Octave> octaves, const std::array<double, 3>& origin,
                  const std::array<std::span<const float>, 3>& offset, std::span<float> value,
                  const GradientSpans<3>& gradient) {
    HWY_DYNAMIC_DISPATCH(FbmGradient3)(octaves, origin, offset, value, gradient);
}
void fbm_hessian(std::span<const Octave> octaves, const std::array<double, 2>& origin,
                 const std::array<std::span<const float>, 2>& offset, std::span<float> value,
                 const GradientSpans<2>& gradient, const HessianSpans<2>& hessian) {
    HWY_DYNAMIC_DISPATCH(FbmHessian2)(octaves, origin, offset, value, gradient, hessian);
}
void fbm_hessian(std::span<const Octave> octaves, const std::array<double, 3>& origin,
                 const std::array<std::span<const float>, 3>& offset, std::span<float> value,
                 const GradientSpans<3>& gradient, const HessianSpans<3>& hessian) {
    HWY_DYNAMIC_DISPATCH(FbmHessian3)(octaves, origin, offset, value, gradient, hessian);
}

}  // namespace strata::noise
#endif  // HWY_ONCE
