#include "noise/noise.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/noise.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "noise/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

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

}  // namespace strata::noise
#endif  // HWY_ONCE
