// Masks of lanes: to go through, to store by, and those of doubles. Include after hwy/foreach_target.h and
// hwy/highway.h.
#if defined(STRATA_TRACE_LANE_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_TRACE_LANE_BITS_INL_H_
#undef STRATA_TRACE_LANE_BITS_INL_H_
#else
#define STRATA_TRACE_LANE_BITS_INL_H_
#endif

#include <bit>
#include <cstdint>

#include "src/trace/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// The lanes of a mask, least first: `for (const std::size_t lane : LaneSet(mask))`.
class LaneSet {
  public:
    HWY_INLINE explicit LaneSet(hn::Mask<FloatTag> mask) {
        alignas(8) std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(FloatTag(), mask, bytes);
        bits_ = std::bit_cast<std::uint64_t>(bytes);
    }

    struct Iterator {
        std::uint64_t bits;
        std::size_t operator*() const { return static_cast<std::size_t>(std::countr_zero(bits)); }
        Iterator& operator++() {
            bits &= bits - 1;
            return *this;
        }
        bool operator==(const Iterator&) const = default;
    };
    Iterator begin() const { return {bits_}; }
    Iterator end() const { return {0}; }
    bool contains(std::size_t lane) const { return (bits_ >> lane & 1) != 0; }

  private:
    std::uint64_t bits_;
};

HWY_INLINE void store_lanes(hn::Mask<FloatTag> lanes, FloatVec v, float* HWY_RESTRICT to) {
    const FloatTag d;
    hn::Store(hn::IfThenElse(lanes, v, hn::Load(d, to)), d, to);
}

struct WideMask {
    std::array<hn::Mask<DoubleTag>, kParts> part;
};

HWY_INLINE WideMask widen(hn::Mask<FloatTag> mask) {
    const DoubleTag d;
    const Wide flag = to_wide(hn::IfThenElseZero(mask, hn::Set(FloatTag(), 1.0f)));
    WideMask result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Gt(flag.part[i], hn::Zero(d));
    return result;
}

HWY_INLINE hn::Mask<FloatTag> narrow(const WideMask& mask) {
    Wide flag;
    for (std::size_t i = 0; i < kParts; ++i) {
        flag.part[i] = hn::IfThenElseZero(mask.part[i], hn::Set(DoubleTag(), 1.0));
    }
    return hn::Gt(to_float(flag), hn::Zero(FloatTag()));
}

HWY_INLINE WideMask greater_equal(const Wide& a, const Wide& b) {
    WideMask result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::Ge(a.part[i], b.part[i]);
    return result;
}

HWY_INLINE Wide select(const WideMask& mask, const Wide& yes, const Wide& no) {
    Wide result;
    for (std::size_t i = 0; i < kParts; ++i) result.part[i] = hn::IfThenElse(mask.part[i], yes.part[i], no.part[i]);
    return result;
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
