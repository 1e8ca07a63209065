// A vector of doubles with as many lanes as a vector of floats: positions along rays need the precision, what is
// derived from them inside one lattice cell does not. Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_TRACE_WIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_WIDE_INL_H_
#undef STRATA_TRACE_WIDE_INL_H_
#else
#define STRATA_TRACE_WIDE_INL_H_
#endif

#include <hwy/highway.h>

#include "noise/noise-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using noise::HWY_NAMESPACE::FloatTag;
using noise::HWY_NAMESPACE::FloatVec;
using noise::HWY_NAMESPACE::WordTag;
using noise::HWY_NAMESPACE::WordVec;
using DoubleTag = hn::ScalableTag<double>;
using DoubleVec = hn::Vec<DoubleTag>;

// Of a vector of floats, at most.
inline constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float);

#if HWY_TARGET == HWY_SCALAR
inline constexpr std::size_t kParts = 1;
#else
inline constexpr std::size_t kParts = 2;
#endif

struct Wide {
    std::array<DoubleVec, kParts> part;
};

template <class Op, class... Args>
HWY_INLINE Wide each_part(const Op& op, const Args&... args) {
    Wide result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = op(args.part[i]...);
    return result;
}

HWY_INLINE Wide load_wide(const double* HWY_RESTRICT from) {
    const DoubleTag d;
    Wide result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Load(d, from + i * hn::Lanes(d));
    return result;
}

HWY_INLINE void store_wide(const Wide& v, double* HWY_RESTRICT to) {
    const DoubleTag d;
    for (std::size_t i = 0; i < kParts; ++i) hn::Store(v.part[i], d, to + i * hn::Lanes(d));
}

HWY_INLINE Wide mul_add(const Wide& a, const Wide& b, const Wide& c) {
    return each_part([](auto x, auto y, auto z) HWY_ATTR { return hn::MulAdd(x, y, z); }, a, b, c);
}

HWY_INLINE Wide mul_add(const Wide& a, double b, double c) {
    const DoubleVec vb = hn::Set(DoubleTag(), b), vc = hn::Set(DoubleTag(), c);
    return each_part([&](auto x) HWY_ATTR { return hn::MulAdd(x, vb, vc); }, a);
}

HWY_INLINE Wide add(const Wide& a, const Wide& b) {
    return each_part([](auto x, auto y) HWY_ATTR { return hn::Add(x, y); }, a, b);
}

HWY_INLINE Wide sub(const Wide& a, const Wide& b) {
    return each_part([](auto x, auto y) HWY_ATTR { return hn::Sub(x, y); }, a, b);
}

HWY_INLINE Wide mul(const Wide& a, const Wide& b) {
    return each_part([](auto x, auto y) HWY_ATTR { return hn::Mul(x, y); }, a, b);
}

HWY_INLINE Wide max(const Wide& a, const Wide& b) {
    return each_part([](auto x, auto y) HWY_ATTR { return hn::Max(x, y); }, a, b);
}

HWY_INLINE Wide same_wide(double x) {
    Wide result;
    result.part.fill(hn::Set(DoubleTag(), x));
    return result;
}

HWY_INLINE Wide root(const Wide& a) {
    return each_part([](auto x) HWY_ATTR { return hn::Sqrt(x); }, a);
}

// a / b, b at least 0; finite where b is 0, too.
HWY_INLINE Wide quotient(const Wide& a, const Wide& b) {
    return each_part([](auto x, auto y) HWY_ATTR { return hn::Div(x, hn::Max(y, hn::Set(DoubleTag(), 1e-300))); }, a,
                     b);
}

HWY_INLINE Wide floor(const Wide& a) {
    return each_part([](auto x) HWY_ATTR { return hn::Floor(x); }, a);
}

HWY_INLINE FloatVec to_float(const Wide& a) {
    const FloatTag d;
#if HWY_TARGET == HWY_SCALAR
    return hn::DemoteTo(d, a.part[0]);
#else
    const hn::Half<FloatTag> half;
    return hn::Combine(d, hn::DemoteTo(half, a.part[1]), hn::DemoteTo(half, a.part[0]));
#endif
}

HWY_INLINE Wide to_wide(FloatVec a) {
    const DoubleTag d;
#if HWY_TARGET == HWY_SCALAR
    return {{hn::PromoteTo(d, a)}};
#else
    const hn::Half<FloatTag> half;
    return {{hn::PromoteTo(d, hn::LowerHalf(half, a)), hn::PromoteTo(d, hn::UpperHalf(half, a))}};
#endif
}

// The two words of a biased cell index (noise/hash.h), from the cell's number as a double of magnitude below 2^51:
// adding 1.5 * 2^52 + 2^31 leaves the biased index in the low 52 bits of the sum.
struct CellWords {
    Wide sum;
};

HWY_INLINE CellWords cell_words(const Wide& cell) {
    const DoubleVec magic = hn::Set(DoubleTag(), 0x1.8p52 + 0x1p31);
    return {each_part([&](auto x) HWY_ATTR { return hn::Add(x, magic); }, cell)};
}

HWY_INLINE WordVec low_word(const CellWords& cell) {
    const WordTag d;
#if HWY_TARGET == HWY_SCALAR
    return hn::Set(
        d, static_cast<std::uint32_t>(hn::GetLane(hn::BitCast(hn::ScalableTag<std::uint64_t>(), cell.sum.part[0]))));
#else
    return hn::ConcatEven(d, hn::BitCast(d, cell.sum.part[1]), hn::BitCast(d, cell.sum.part[0]));
#endif
}

HWY_INLINE WordVec high_word(const CellWords& cell) {
    const WordTag d;
    constexpr std::uint32_t kMagicHigh = 0x43380000u;  // high word of 1.5 * 2^52
#if HWY_TARGET == HWY_SCALAR
    const auto bits = hn::GetLane(hn::BitCast(hn::ScalableTag<std::uint64_t>(), cell.sum.part[0]));
    const WordVec high = hn::Set(d, static_cast<std::uint32_t>(bits >> 32));
#else
    const WordVec high = hn::ConcatOdd(d, hn::BitCast(d, cell.sum.part[1]), hn::BitCast(d, cell.sum.part[0]));
#endif
    return hn::Sub(high, hn::Set(d, kMagicHigh));
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
