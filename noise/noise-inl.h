// Gradient noise on a vector of points, for every SIMD target. Include after hwy/foreach_target.h and hwy/highway.h.
//
// A point is, per axis, a lattice plane below it (as Plane words) and a fraction in [0,1]. A lane's result depends on
// that lane alone.
#if defined(STRATA_NOISE_NOISE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_NOISE_INL_H_
#undef STRATA_NOISE_NOISE_INL_H_
#else
#define STRATA_NOISE_NOISE_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

#include "noise/gradients.h"
#include "noise/hash.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using WordTag = hn::RebindToUnsigned<FloatTag>;
using IndexTag = hn::RebindToSigned<FloatTag>;
using FloatVec = hn::Vec<FloatTag>;
using WordVec = hn::Vec<WordTag>;

HWY_INLINE FloatVec lerp(FloatVec a, FloatVec b, FloatVec t) { return hn::MulAdd(t, hn::Sub(b, a), a); }

// Hash words of the planes below and above a point on one axis.
struct Planes {
    WordVec below, above;
};

HWY_INLINE WordVec plane_words(WordVec lo, WordVec block) {
    const WordVec s = hn::Xor(lo, block);
    const WordVec t = hn::Mul(hn::Xor(s, hn::ShiftRight<kWordShift>(s)), hn::Set(WordTag(), kAxisMultiplier));
    return hn::Xor(t, hn::ShiftRight<kAxisShift>(t));
}

// lo: low word of the biased cell index; block: block_word of its high word, the same for lo and lo + 1.
HWY_INLINE Planes planes(WordVec lo, WordVec block) {
    return {plane_words(lo, block), plane_words(hn::Add(lo, hn::Set(WordTag(), 1u)), block)};
}

// Where lo + 1 wraps around, the plane above lies in the next block.
HWY_INLINE Planes planes(WordVec lo, WordVec block, WordVec next_block) {
    const WordVec above = hn::Add(lo, hn::Set(WordTag(), 1u));
    const auto wraps = hn::Eq(above, hn::Zero(WordTag()));
    return {plane_words(lo, block), plane_words(above, hn::IfThenElse(wraps, next_block, block))};
}

// mix32 of hash.h, a vector at a time.
HWY_INLINE WordVec mix_words(WordVec x) {
    const WordTag d;
    x = hn::Xor(x, hn::ShiftRight<16>(x));
    x = hn::Mul(x, hn::Set(d, 0x7FEB352Du));
    x = hn::Xor(x, hn::ShiftRight<15>(x));
    x = hn::Mul(x, hn::Set(d, 0x846CA68Bu));
    return hn::Xor(x, hn::ShiftRight<16>(x));
}

// Planes from both words of the biased cell index, one block a lane.
HWY_INLINE Planes planes_wide(WordVec lo, WordVec hi, std::uint32_t key) {
    const WordTag d;
    const WordVec next_hi = hn::Add(hi, hn::Set(d, 1u));
    return planes(lo, mix_words(hn::Xor(hi, hn::Set(d, key))), mix_words(hn::Xor(next_hi, hn::Set(d, key))));
}

// Gradient components are looked up twice as large: +-2 has only its top byte set, so one byte shuffle fetches it.
inline constexpr float kGradientScale3 = 0.5f;

#if HWY_TARGET == HWY_SCALAR

template <std::size_t kAxis>
HWY_INLINE FloatVec gradient3(WordVec hash) {
    const auto& g = kGradients3[(hn::GetLane(hash) >> kGradientShift) & 15u];
    return hn::Set(FloatTag(), 2.0f * static_cast<float>(g[kAxis]));
}

template <std::size_t kAxis>
HWY_INLINE FloatVec gradient2(WordVec hash) {
    return hn::Set(FloatTag(), kGradients2[(hn::GetLane(hash) >> kGradientShift) & 7u][kAxis]);
}

HWY_INLINE WordVec selector3(WordVec hash) { return hash; }
HWY_INLINE WordVec selector2(WordVec hash) { return hash; }

#else

struct ByteTable {
    alignas(16) std::array<std::uint8_t, 16> bytes{};
};

constexpr ByteTable top_bytes3(std::size_t axis) {
    ByteTable table;
    for (std::size_t i = 0; i < 16; ++i) {
        table.bytes[i] = kGradients3[i][axis] > 0 ? 0x40 : kGradients3[i][axis] < 0 ? 0xC0 : 0x00;
    }
    return table;
}

// Entries 0..7 are the top bytes, 8..15 the second bytes of the eight 2-D gradients; their lower bytes are zero.
constexpr ByteTable two_bytes2(std::size_t axis) {
    ByteTable table;
    for (std::size_t i = 0; i < 8; ++i) {
        const float g = kGradients2[i][axis];
        const bool is_long = g == kGradientLong || g == -kGradientLong;
        table.bytes[i] = static_cast<std::uint8_t>((is_long ? 0x3F : 0x3E) | (g < 0.0f ? 0x80 : 0x00));
        table.bytes[i + 8] = is_long ? 0x6D : 0xC4;  // 0.92578125f = 0x3F6D0000, 0.3828125f = 0x3EC40000
    }
    return table;
}

template <std::size_t kDimension, std::size_t kAxis>
inline constexpr ByteTable kGradientBytes = kDimension == 3 ? top_bytes3(kAxis) : two_bytes2(kAxis);

template <std::size_t kDimension, std::size_t kAxis>
HWY_INLINE FloatVec gradient_bytes(WordVec selector) {
    const hn::Repartition<std::uint8_t, FloatTag> bytes;
    const auto table = hn::LoadDup128(bytes, kGradientBytes<kDimension, kAxis>.bytes.data());
    return hn::BitCast(FloatTag(), hn::TableLookupBytesOr0(table, hn::BitCast(bytes, selector)));
}

template <std::size_t kAxis>
HWY_INLINE FloatVec gradient3(WordVec selector) {
    return gradient_bytes<3, kAxis>(selector);
}

template <std::size_t kAxis>
HWY_INLINE FloatVec gradient2(WordVec selector) {
    return gradient_bytes<2, kAxis>(selector);
}

// Byte indices: 0x80 yields a zero byte.
HWY_INLINE WordVec selector3(WordVec hash) {
    const WordTag d;
    return hn::OrAnd(hn::Set(d, 0x00808080u), hash, hn::Set(d, 0x0F000000u));
}

HWY_INLINE WordVec selector2(WordVec hash) {
    const WordTag d;
    const WordVec index = hn::And(hash, hn::Set(d, 0x07000000u));
    return hn::Or(hn::Or(index, hn::ShiftRight<8>(index)), hn::Set(d, 0x00088080u));
}

#endif

// The quintic fade of one axis (Perlin 2002) about the middle of the cell, with u = t - 1/2 and q = 1/4 - u^2:
//   fade = t^3 (6 t^2 - 15 t + 10) = 1/2 + u (1 + 2 q + 6 q^2),   fade' = 30 q^2,   fade'' = -120 u q,
// where no sum is much smaller than its terms, as 6 t^2 - 15 t + 10 is: a tenth of the rounding error (float_error.h).
struct Fade {
    FloatVec u, q;
};

HWY_INLINE Fade fade_of(FloatVec t) {
    const FloatTag d;
    const FloatVec u = hn::Sub(t, hn::Set(d, 0.5f));
    return {u, hn::NegMulAdd(u, u, hn::Set(d, 0.25f))};
}

HWY_INLINE FloatVec fade(const Fade& at) {
    const FloatTag d;
    const FloatVec poly = hn::MulAdd(at.q, hn::MulAdd(at.q, hn::Set(d, 6.0f), hn::Set(d, 2.0f)), hn::Set(d, 1.0f));
    return hn::MulAdd(at.u, poly, hn::Set(d, 0.5f));
}

HWY_INLINE FloatVec fade_derivative(const Fade& at) { return hn::Mul(hn::Set(FloatTag(), 30.0f), hn::Mul(at.q, at.q)); }

HWY_INLINE FloatVec fade_second(const Fade& at) { return hn::Mul(hn::Set(FloatTag(), -120.0f), hn::Mul(at.u, at.q)); }

// A form that is linear in each of u, v [, w], from its corner values, with its partial derivatives. What a caller does
// not read is not computed: all is inlined.
struct Bilinear {
    FloatVec value, du, dv, duv;
};

HWY_INLINE Bilinear bilinear(FloatVec c00, FloatVec c10, FloatVec c01, FloatVec c11, FloatVec u, FloatVec v) {
    const FloatVec e0 = hn::Sub(c10, c00), e1 = hn::Sub(c11, c01);
    const FloatVec a0 = hn::MulAdd(u, e0, c00), a1 = hn::MulAdd(u, e1, c01);
    const FloatVec dv = hn::Sub(a1, a0), duv = hn::Sub(e1, e0);
    return {hn::MulAdd(v, dv, a0), hn::MulAdd(v, duv, e0), dv, duv};
}

struct Trilinear {
    FloatVec value, du, dv, dw, duv, duw, dvw;
};

HWY_INLINE Trilinear trilinear(const Bilinear& near, const Bilinear& far, FloatVec w) {
    const FloatVec dw = hn::Sub(far.value, near.value), duw = hn::Sub(far.du, near.du), dvw = hn::Sub(far.dv, near.dv);
    return {hn::MulAdd(w, dw, near.value),
            hn::MulAdd(w, duw, near.du),
            hn::MulAdd(w, dvw, near.dv),
            dw,
            lerp(near.duv, far.duv, w),
            duw,
            dvw};
}

struct Jet2 {
    FloatVec value, dx, dy, dxx, dxy, dyy;
};

// 2-D noise with gradient and Hessian at the fraction (x, y).
HWY_INLINE Jet2 noise2(const Planes& px, const Planes& py, FloatVec x, FloatVec y) {
    const FloatTag d;
    const FloatVec one = hn::Set(d, 1.0f);
    const WordVec multiplier = hn::Set(WordTag(), kCornerMultiplier);
    const FloatVec x1 = hn::Sub(x, one), y1 = hn::Sub(y, one);
    const Fade fx = fade_of(x), fy = fade_of(y);
    const FloatVec u = fade(fx), v = fade(fy);
    std::array<FloatVec, 4> dot, gx, gy;
    HWY_UNROLL(4)
    for (std::size_t c = 0; c < 4; ++c) {
        const WordVec word = hn::Xor(c & 1 ? px.above : px.below, c & 2 ? py.above : py.below);
        const WordVec selector = selector2(hn::Mul(word, multiplier));
        gx[c] = gradient2<0>(selector);
        gy[c] = gradient2<1>(selector);
        dot[c] = hn::MulAdd(gy[c], c & 2 ? y1 : y, hn::Mul(gx[c], c & 1 ? x1 : x));
    }
    const Bilinear n = bilinear(dot[0], dot[1], dot[2], dot[3], u, v);
    const Bilinear a = bilinear(gx[0], gx[1], gx[2], gx[3], u, v);
    const Bilinear b = bilinear(gy[0], gy[1], gy[2], gy[3], u, v);
    const FloatVec du = fade_derivative(fx), dv = fade_derivative(fy);
    const FloatVec two = hn::Set(d, 2.0f);
    return {n.value,
            hn::MulAdd(du, n.du, a.value),
            hn::MulAdd(dv, n.dv, b.value),
            hn::MulAdd(fade_second(fx), n.du, hn::Mul(hn::Mul(two, du), a.du)),
            hn::MulAdd(du, hn::MulAdd(dv, n.duv, b.du), hn::Mul(dv, a.dv)),
            hn::MulAdd(fade_second(fy), n.dv, hn::Mul(hn::Mul(two, dv), b.dv))};
}

struct Jet3 {
    FloatVec value, dx, dy, dz, dxx, dyy, dzz, dxy, dxz, dyz;
};

// One face z = const of a cell: the corner dots and gradients as bilinear forms in (u, v).
struct Face {
    Bilinear dot, gx, gy, gz;
};

HWY_INLINE Face face(const Planes& px, const Planes& py, WordVec pz, FloatVec x, FloatVec y, FloatVec z, FloatVec u,
                     FloatVec v) {
    const FloatVec one = hn::Set(FloatTag(), 1.0f);
    const WordVec multiplier = hn::Set(WordTag(), kCornerMultiplier);
    const FloatVec x1 = hn::Sub(x, one), y1 = hn::Sub(y, one);
    const WordVec row0 = hn::Xor(py.below, pz), row1 = hn::Xor(py.above, pz);
    std::array<FloatVec, 4> dot, gx, gy, gz;
    HWY_UNROLL(4)
    for (std::size_t c = 0; c < 4; ++c) {
        const WordVec word = hn::Xor(c & 1 ? px.above : px.below, c & 2 ? row1 : row0);
        const WordVec selector = selector3(hn::Mul(word, multiplier));
        gx[c] = gradient3<0>(selector);
        gy[c] = gradient3<1>(selector);
        gz[c] = gradient3<2>(selector);
        dot[c] = hn::MulAdd(gz[c], z, hn::MulAdd(gy[c], c & 2 ? y1 : y, hn::Mul(gx[c], c & 1 ? x1 : x)));
    }
    return {bilinear(dot[0], dot[1], dot[2], dot[3], u, v), bilinear(gx[0], gx[1], gx[2], gx[3], u, v),
            bilinear(gy[0], gy[1], gy[2], gy[3], u, v), bilinear(gz[0], gz[1], gz[2], gz[3], u, v)};
}

// 3-D noise with gradient and Hessian at the fraction (x, y, z).
HWY_INLINE Jet3 noise3(const Planes& px, const Planes& py, const Planes& pz, FloatVec x, FloatVec y, FloatVec z) {
    const FloatTag d;
    const Fade fx = fade_of(x), fy = fade_of(y), fz = fade_of(z);
    const FloatVec u = fade(fx), v = fade(fy), w = fade(fz);
    const Face near = face(px, py, pz.below, x, y, z, u, v);
    const Face far = face(px, py, pz.above, x, y, hn::Sub(z, hn::Set(d, 1.0f)), u, v);
    const Trilinear n = trilinear(near.dot, far.dot, w), a = trilinear(near.gx, far.gx, w);
    const Trilinear b = trilinear(near.gy, far.gy, w), c = trilinear(near.gz, far.gz, w);
    const FloatVec du = fade_derivative(fx), dv = fade_derivative(fy), dw = fade_derivative(fz);
    const FloatVec half = hn::Set(d, kGradientScale3);
    Jet3 jet;
    jet.value = hn::Mul(half, n.value);
    jet.dx = hn::Mul(half, hn::MulAdd(du, n.du, a.value));
    jet.dy = hn::Mul(half, hn::MulAdd(dv, n.dv, b.value));
    jet.dz = hn::Mul(half, hn::MulAdd(dw, n.dw, c.value));
    jet.dxx = hn::MulAdd(hn::Mul(half, fade_second(fx)), n.du, hn::Mul(du, a.du));
    jet.dyy = hn::MulAdd(hn::Mul(half, fade_second(fy)), n.dv, hn::Mul(dv, b.dv));
    jet.dzz = hn::MulAdd(hn::Mul(half, fade_second(fz)), n.dw, hn::Mul(dw, c.dw));
    jet.dxy = hn::Mul(half, hn::MulAdd(du, hn::MulAdd(dv, n.duv, b.du), hn::Mul(dv, a.dv)));
    jet.dxz = hn::Mul(half, hn::MulAdd(du, hn::MulAdd(dw, n.duw, c.du), hn::Mul(dw, a.dw)));
    jet.dyz = hn::Mul(half, hn::MulAdd(dv, hn::MulAdd(dw, n.dvw, c.dv), hn::Mul(dw, b.dw)));
    return jet;
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
