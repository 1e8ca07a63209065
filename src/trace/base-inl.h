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

HWY_INLINE Base plane_at(const WidePoint& x, const WidePoint& direction) {
    return {to_float(x.y), to_float(direction.y)};
}

HWY_INLINE Base sphere_at(const Field& field, const WidePoint& x, const WidePoint& direction) {
    const Wide squared = mul_add(x.x, x.x, mul_add(x.y, x.y, mul(x.z, x.z)));
    const Wide along = mul_add(x.x, direction.x, mul_add(x.y, direction.y, mul(x.z, direction.z)));
    const Wide radius = each_part([](auto v) HWY_ATTR { return hn::Sqrt(v); }, squared);
    const Wide slope = each_part(
        [](auto a, auto r) HWY_ATTR { return hn::Div(a, hn::Max(r, hn::Set(DoubleTag(), 1e-300))); }, along, radius);
    const DoubleVec mean = hn::Set(DoubleTag(), field.surface().radius);
    return {to_float(each_part([&](auto r) HWY_ATTR { return hn::Sub(r, mean); }, radius)), to_float(slope)};
}

// kPlanar: the noise is 2-D, which it is over a plane alone. The shapes under 3-D noise share one tracer: choosing
// among them at every step of a packet costs nothing beside an octave, and a tracer for each took three times as long
// to compile.
template <bool kPlanar>
HWY_INLINE Base base_at(const Field& field, const WidePoint& x, const WidePoint& direction) {
    if constexpr (kPlanar) return plane_at(x, direction);
    const FloatTag d;
    switch (field.kind()) {
        case scene::SurfaceKind::isosurface:
            return {hn::Set(d, static_cast<float>(field.surface().threshold)), hn::Zero(d)};
        case scene::SurfaceKind::planet:
            return sphere_at(field, x, direction);
        default:
            return plane_at(x, direction);
    }
}

HWY_INLINE FloatPoint sphere_gradient_at(const WidePoint& x) {
    const Wide squared = mul_add(x.x, x.x, mul_add(x.y, x.y, mul(x.z, x.z)));
    const Wide scale = each_part(
        [](auto v)
            HWY_ATTR { return hn::Div(hn::Set(DoubleTag(), 1.0), hn::Max(hn::Sqrt(v), hn::Set(DoubleTag(), 1e-300))); },
        squared);
    return {to_float(mul(x.x, scale)), to_float(mul(x.y, scale)), to_float(mul(x.z, scale))};
}

// The gradient of the part without noise, whose tangent is a lower bound all around.
template <bool kPlanar>
HWY_INLINE FloatPoint base_gradient_at(const Field& field, const WidePoint& x) {
    const FloatTag d;
    const FloatPoint up = {hn::Zero(d), hn::Set(d, 1.0f), hn::Zero(d)};
    if constexpr (kPlanar) return up;
    switch (field.kind()) {
        case scene::SurfaceKind::isosurface:
            return {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        case scene::SurfaceKind::planet:
            return sphere_gradient_at(x);
        default:
            return up;
    }
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
