// The part of f without noise, on a vector of points. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_BASE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_BASE_INL_H_
#undef STRATA_TRACE_BASE_INL_H_
#else
#define STRATA_TRACE_BASE_INL_H_
#endif

#include "src/trace/field.h"
#include "src/trace/octave-inl.h"
#define STRATA_SOLID_LANES
#include "src/solid/all.h"
#undef STRATA_SOLID_LANES

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

// What the solids' formulas (src/solid) are read with.
struct SolidLanes {
    using Point = WidePoint;
    using Base = HWY_NAMESPACE::Base;
    using Gradient = FloatPoint;
    static HWY_INLINE FloatVec number(double x) { return hn::Set(FloatTag(), static_cast<float>(x)); }
    static HWY_INLINE Wide wide(double x) { return same_wide(x); }
};

// What `f` makes of the field's solid, as its own type. kPlanar: the noise is 2-D; solids over noise of other
// dimensions are not asked for. Those over 3-D noise share one tracer: choosing among them at every step of a packet
// costs nothing beside an octave, and a tracer for each took three times as long to compile.
template <bool kPlanar, std::size_t I = 0, class F>
HWY_INLINE auto with_solid(const Field& field, const F& f) {
    constexpr int kDimensions = kPlanar ? 2 : 3;
    constexpr auto is_wanted = [](std::size_t i) { return solid::all_solids()[i].dimensions == kDimensions; };
    constexpr bool kIsLast = [&] {
        for (std::size_t i = I + 1; i < solid::kKinds; ++i) {
            if (is_wanted(i)) return false;
        }
        return true;
    }();
    if constexpr (!is_wanted(I)) {
        return with_solid<kPlanar, I + 1>(field, f);
    } else {
        if constexpr (!kIsLast) {
            if (field.solid().index() != I) return with_solid<kPlanar, I + 1>(field, f);
        }
        return f(*std::get_if<I>(&field.solid()));
    }
}

template <bool kPlanar>
HWY_INLINE Base base_at(const Field& field, const WidePoint& x, const WidePoint& direction) {
    return with_solid<kPlanar>(
        field, [&](const auto& s) HWY_ATTR { return solid::HWY_NAMESPACE::base_of<SolidLanes>(s, x, direction); });
}

// The gradient of the part without noise, whose tangent is a lower bound all around.
template <bool kPlanar>
HWY_INLINE FloatPoint base_gradient_at(const Field& field, const WidePoint& x) {
    return with_solid<kPlanar>(
        field, [&](const auto& s) HWY_ATTR { return solid::HWY_NAMESPACE::gradient_of<SolidLanes>(s, x); });
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
