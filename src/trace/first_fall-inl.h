// Where a vector of parabolas first falls through zero. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_FIRST_FALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_FIRST_FALL_INL_H_
#undef STRATA_TRACE_FIRST_FALL_INL_H_
#else
#define STRATA_TRACE_FIRST_FALL_INL_H_
#endif

#include "src/trace/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// kFallPad (|c0| + |c1| + |c2|) bounds by how much, over [0, 1], the parabola whose root first_fall finds differs from
// the one that it was given, and kFallPlace by which fraction the root itself is off.
//
// Derivation, with u = 2^-24. The discriminant comes out as (c1^2 (1 + e1) - 4 c2 c0) (1 + e2), |e| <= u, the fused
// product being exact; without fusion c2 c0 carries another (1 + e3). That is (1 + e2) times the exact discriminant of
// a parabola whose c1 is off by u/2 and whose c2 by u of itself, so the sign of the discriminant, and with it whether
// and where there is a first root, is that parabola's. What follows are the square root, one sum of terms of equal
// sign, the other term of the quotient and the quotient: each within u of its result, and half of e2, below 5 u
// together.
//
// What underflows, 2^-125 of the discriminant at most, is as though c1 were off by less than 2^-62. Callers whose error
// is at least kLeastFall, and 2^-20 of itself more than it need be, have that covered.
inline constexpr float kFallPad = 2.0f * 0x1p-24f;
inline constexpr float kFallPlace = 8.0f * 0x1p-24f;
inline constexpr float kLeastFall = 0x1p-30f;

// The first x >= 0 at which c0 + c1 x + c2 x^2 falls to 0; 0 where c0 <= 0; 1e30 where it never does. Of the two forms
// of the root the one that adds terms of equal sign is taken.
HWY_INLINE FloatVec first_fall(FloatVec c0, FloatVec c1, FloatVec c2) {
    const FloatTag d;
    const FloatVec zero = hn::Zero(d), none = hn::Set(d, 1e30f);
    const FloatVec discriminant = hn::NegMulAdd(hn::Mul(hn::Set(d, 4.0f), c2), c0, hn::Mul(c1, c1));
    const FloatVec root = hn::Sqrt(hn::Max(discriminant, zero));
    const auto falls = hn::Le(c1, zero);
    const FloatVec numerator = hn::IfThenElse(falls, hn::Add(c0, c0), hn::Add(c1, root));
    const FloatVec denominator = hn::IfThenElse(falls, hn::Sub(root, c1), hn::Mul(hn::Set(d, -2.0f), c2));
    const auto has_root = hn::And(hn::Ge(discriminant, zero), hn::Gt(denominator, zero));
    const FloatVec x = hn::IfThenElse(has_root, hn::Min(hn::Div(numerator, denominator), none), none);
    return hn::IfThenElse(hn::Le(c0, zero), zero, x);
}

// The same, moved back and forth by what it may be off by.
HWY_INLINE FloatVec fall_no_later(FloatVec c0, FloatVec c1, FloatVec c2) {
    return hn::Mul(first_fall(c0, c1, c2), hn::Set(FloatTag(), 1.0f - kFallPlace));
}

HWY_INLINE FloatVec fall_no_sooner(FloatVec c0, FloatVec c1, FloatVec c2) {
    return hn::Mul(first_fall(c0, c1, c2), hn::Set(FloatTag(), 1.0f + kFallPlace));
}

// |c0| + |c1| + |c2|.
HWY_INLINE FloatVec fall_size(FloatVec c0, FloatVec c1, FloatVec c2) {
    return hn::Add(hn::Abs(c0), hn::Add(hn::Abs(c1), hn::Abs(c2)));
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
