#include "src/accel/interleave_simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/accel/interleave_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which sets the target.
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace strata::accel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::ScalableTag<double>;
using WordTag = hn::RebindToUnsigned<DoubleTag>;
using WordVec = hn::Vec<WordTag>;

// floor(x * scale) + bias, clamped to [0, 2 bias), in the low half of each lane: 2^52 added leaves it in the low bits.
HWY_INLINE WordVec column(const double* x, double scale, double bias) {
    const DoubleTag d;
    const auto scaled = hn::Mul(hn::LoadU(d, x), hn::Set(d, scale));
    const auto inside = hn::Min(hn::Max(scaled, hn::Set(d, -bias)), hn::Set(d, bias - 1.0));
    const auto sum = hn::Add(hn::Floor(inside), hn::Set(d, 0x1p52 + bias));
    return hn::And(hn::BitCast(WordTag(), sum), hn::Set(WordTag(), 0xffff'ffff));
}

// Bits of x at even places, bits of y at odd ones, of 16 each.
HWY_INLINE WordVec interleave_16(WordVec x, WordVec y) {
    const WordTag d;
    WordVec both = hn::Or(x, hn::ShiftLeft<32>(y));
    both = hn::And(hn::Or(both, hn::ShiftLeft<8>(both)), hn::Set(d, 0x00ff'00ff'00ff'00ff));
    both = hn::And(hn::Or(both, hn::ShiftLeft<4>(both)), hn::Set(d, 0x0f0f'0f0f'0f0f'0f0f));
    both = hn::And(hn::Or(both, hn::ShiftLeft<2>(both)), hn::Set(d, 0x3333'3333'3333'3333));
    both = hn::And(hn::Or(both, hn::ShiftLeft<1>(both)), hn::Set(d, 0x5555'5555'5555'5555));
    return hn::And(hn::Or(both, hn::ShiftRight<31>(both)), hn::Set(d, 0xffff'ffff));
}

HWY_INLINE WordVec interleave(WordVec x, WordVec y) {
    const WordVec low = hn::Set(WordTag(), 0xffff);
    return hn::Or(interleave_16(hn::And(x, low), hn::And(y, low)),
                  hn::ShiftLeft<32>(interleave_16(hn::ShiftRight<16>(x), hn::ShiftRight<16>(y))));
}

void Interleave(std::span<const double> u, std::span<const double> v, double scale, double bias,
                std::span<std::uint64_t> out) {
    const WordTag d;
    const std::size_t lanes = hn::Lanes(d), whole = out.size() / lanes * lanes;
    const auto codes = [&](const double* x, const double* y)
                           HWY_ATTR { return interleave(column(x, scale, bias), column(y, scale, bias)); };
    for (std::size_t i = 0; i < whole; i += lanes) hn::StoreU(codes(&u[i], &v[i]), d, &out[i]);
    if (whole == out.size()) return;
    alignas(HWY_MAX_BYTES) double x[HWY_MAX_BYTES / sizeof(double)] = {}, y[HWY_MAX_BYTES / sizeof(double)] = {};
    alignas(HWY_MAX_BYTES) std::uint64_t last[HWY_MAX_BYTES / sizeof(double)];
    std::copy(u.begin() + static_cast<std::ptrdiff_t>(whole), u.end(), x);
    std::copy(v.begin() + static_cast<std::ptrdiff_t>(whole), v.end(), y);
    hn::Store(codes(x, y), d, last);
    std::copy_n(last, out.size() - whole, &out[whole]);
}

}  // namespace strata::accel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::accel {

HWY_EXPORT(Interleave);

void interleave_columns(std::span<const double> u, std::span<const double> v, double scale, double bias,
                        std::span<std::uint64_t> out) {
    HWY_DYNAMIC_DISPATCH(Interleave)(u, v, scale, bias, out);
}

namespace {

std::uint64_t bits_at_even_places(std::uint64_t x) {
    x &= 0x5555'5555'5555'5555;
    x = (x | x >> 1) & 0x3333'3333'3333'3333;
    x = (x | x >> 2) & 0x0f0f'0f0f'0f0f'0f0f;
    x = (x | x >> 4) & 0x00ff'00ff'00ff'00ff;
    x = (x | x >> 8) & 0x0000'ffff'0000'ffff;
    return (x | x >> 16) & 0xffff'ffff;
}

}  // namespace

Square square_of(std::uint64_t code) { return {bits_at_even_places(code), bits_at_even_places(code >> 1)}; }

}  // namespace strata::accel
#endif  // HWY_ONCE
