#include "src/filter/bspline_table_simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/filter/bspline_table_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which sets the target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace strata::filter::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Coefficients {
    V c0, c1, c2, c3;
};

#if HWY_TARGET == HWY_SCALAR

template <class D, class V = hn::Vec<D>>
HWY_INLINE Coefficients<V> look_up(D d, const Cubic* cubics, hn::Vec<hn::RebindToSigned<D>> cell) {
    const float* const c = cubics[hn::GetLane(cell)].coefficients;
    return {hn::Set(d, c[0]), hn::Set(d, c[1]), hn::Set(d, c[2]), hn::Set(d, c[3])};
}

#else

// The cubics of cells k, k+4, k+8, ..., one a 128-bit block.
template <class D>
HWY_INLINE hn::Vec<D> load_blocks(D d, const Cubic* cubics, const std::int32_t* cell) {
    if constexpr (hn::MaxLanes(d) <= 4) {
        return hn::Load(d, cubics[cell[0]].coefficients);
    } else {
        const hn::Half<D> dh;
        return hn::Combine(d, load_blocks(dh, cubics, cell + hn::MaxLanes(dh)), load_blocks(dh, cubics, cell));
    }
}

// A cell is one 128-bit load, and a transposition within the blocks sorts the coefficients: faster than four gathers.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Coefficients<V> look_up(D d, const Cubic* cubics, hn::Vec<hn::RebindToSigned<D>> cell) {
    const hn::RebindToSigned<D> di;
    const hn::Repartition<double, D> dd;
    HWY_ALIGN std::int32_t cells[hn::MaxLanes(d)];
    hn::Store(cell, di, cells);
    const V r0 = load_blocks(d, cubics, cells);
    const V r1 = load_blocks(d, cubics, cells + 1);
    const V r2 = load_blocks(d, cubics, cells + 2);
    const V r3 = load_blocks(d, cubics, cells + 3);
    const auto low01 = hn::BitCast(dd, hn::InterleaveLower(d, r0, r1));
    const auto low23 = hn::BitCast(dd, hn::InterleaveLower(d, r2, r3));
    const auto high01 = hn::BitCast(dd, hn::InterleaveUpper(d, r0, r1));
    const auto high23 = hn::BitCast(dd, hn::InterleaveUpper(d, r2, r3));
    return {hn::BitCast(d, hn::InterleaveLower(dd, low01, low23)),
            hn::BitCast(d, hn::InterleaveUpper(dd, low01, low23)),
            hn::BitCast(d, hn::InterleaveLower(dd, high01, high23)),
            hn::BitCast(d, hn::InterleaveUpper(dd, high01, high23))};
}

#endif

// least keeps the lowest cell asked for, before clamping.
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE V evaluate_vector(D d, const CubicTable& table, V q, VI& least) {
    const hn::RebindToSigned<D> di;
    const auto bits = hn::BitCast(di, hn::Abs(q));

    // The cell, and the position in it: its low bits as the mantissa of a float in [1,2), less 3/2.
    const auto first = hn::Set(di, table.first_cell);
    const auto cell = hn::Min(hn::ShiftRight<kCellShift>(bits), hn::Set(di, table.last_cell));
    least = hn::Min(least, cell);
    const auto mantissa = hn::ShiftLeft<23 - kCellShift>(hn::And(bits, hn::Set(di, (1 << kCellShift) - 1)));
    const auto t = hn::Sub(hn::BitCast(d, hn::Or(mantissa, hn::Set(di, 0x3F800000))), hn::Set(d, 1.5f));

    const auto c = look_up(d, table.cubics, hn::Sub(hn::Max(cell, first), first));
    const auto value = hn::MulAdd(hn::MulAdd(hn::MulAdd(c.c3, t, c.c2), t, c.c1), t, c.c0);
    return hn::CopySign(value, q);
}

bool evaluate_cubics(const CubicTable& table, const float* q, std::size_t count, float* x) {
    const HWY_FULL(float) d;
    const hn::RebindToSigned<decltype(d)> di;
    const std::size_t lanes = hn::Lanes(d);
    auto least = hn::Set(di, table.last_cell);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) hn::StoreU(evaluate_vector(d, table, hn::LoadU(d, q + i), least), d, x + i);

    // The rest goes through a whole vector, so that a lane's arithmetic does not depend on where it stands.
    if (i < count) {
        HWY_ALIGN float buffer[hn::MaxLanes(d)];
        hn::Store(hn::Set(d, 0.5f), d, buffer);
        for (std::size_t k = i; k < count; ++k) buffer[k - i] = q[k];
        hn::Store(evaluate_vector(d, table, hn::Load(d, buffer), least), d, buffer);
        for (std::size_t k = i; k < count; ++k) x[k] = buffer[k - i];
    }
    return !hn::AllFalse(di, hn::Lt(least, hn::Set(di, table.first_cell)));
}

}  // namespace HWY_NAMESPACE
}  // namespace strata::filter::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::filter::detail {

HWY_EXPORT(evaluate_cubics);

bool evaluate_cubics(const CubicTable& table, const float* q, std::size_t count, float* x) {
    return HWY_DYNAMIC_DISPATCH(evaluate_cubics)(table, q, count, x);
}

}  // namespace strata::filter::detail
#endif
