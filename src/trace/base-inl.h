// The part of f without noise, on a vector of points. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_BASE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_BASE_INL_H_
#undef STRATA_TRACE_BASE_INL_H_
#else
#define STRATA_TRACE_BASE_INL_H_
#endif

#include "src/trace/field.h"
#include "src/trace/octave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

using scene::SurfaceKind;

template <SurfaceKind kKind>
inline constexpr bool kIsPlanar = kKind == SurfaceKind::terrain;

struct FloatPoint {
    FloatVec x, y, z;
};

HWY_INLINE FloatVec dot(const FloatPoint& a, const FloatPoint& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE FloatPoint to_float(const WidePoint& a) { return {to_float(a.x), to_float(a.y), to_float(a.z)}; }

// The part of f without noise and its slope along the ray. All bases are linear or convex along a ray, so their
// tangent is a lower bound.
struct Base {
    FloatVec value, slope;
};

template <SurfaceKind kKind>
HWY_INLINE Base base_at(const Field& field, const WidePoint& x, const WidePoint& direction) {
    const FloatTag d;
    if constexpr (kKind == SurfaceKind::isosurface) {
        return {hn::Set(d, static_cast<float>(field.surface().threshold)), hn::Zero(d)};
    } else if constexpr (kKind == SurfaceKind::planet) {
        const Wide squared = mul_add(x.x, x.x, mul_add(x.y, x.y, mul(x.z, x.z)));
        const Wide along = mul_add(x.x, direction.x, mul_add(x.y, direction.y, mul(x.z, direction.z)));
        const Wide radius = each_part([](auto v) HWY_ATTR { return hn::Sqrt(v); }, squared);
        const Wide slope =
            each_part([](auto a, auto r) HWY_ATTR { return hn::Div(a, hn::Max(r, hn::Set(DoubleTag(), 1e-300))); },
                      along, radius);
        const DoubleVec mean = hn::Set(DoubleTag(), field.surface().radius);
        return {to_float(each_part([&](auto r) HWY_ATTR { return hn::Sub(r, mean); }, radius)), to_float(slope)};
    } else {
        return {to_float(x.y), to_float(direction.y)};
    }
}

// Of the part without noise, whose tangent is a lower bound all around.
template <SurfaceKind kKind>
HWY_INLINE FloatPoint base_gradient_at(const WidePoint& x) {
    const FloatTag d;
    if constexpr (kKind == SurfaceKind::isosurface) return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    if constexpr (kKind == SurfaceKind::planet) {
        const Wide squared = mul_add(x.x, x.x, mul_add(x.y, x.y, mul(x.z, x.z)));
        const Wide scale = each_part(
            [](auto v) HWY_ATTR {
                return hn::Div(hn::Set(DoubleTag(), 1.0), hn::Max(hn::Sqrt(v), hn::Set(DoubleTag(), 1e-300)));
            },
            squared);
        return {to_float(mul(x.x, scale)), to_float(mul(x.y, scale)), to_float(mul(x.z, scale))};
    }
    return {hn::Zero(d), hn::Set(d, 1.0f), hn::Zero(d)};
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
