// What batches of noise and of fBm share: positions on the lattice, and spans read and written a vector at a time.
// Include after hwy/foreach_target.h and hwy/highway.h.
#if defined(STRATA_NOISE_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_BATCH_INL_H_
#undef STRATA_NOISE_BATCH_INL_H_
#else
#define STRATA_NOISE_BATCH_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "noise/noise-inl.h"
#include "noise/noise.h"

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

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
