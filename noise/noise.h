// Batches of gradient noise and fBm on the CPU's widest SIMD target (Highway chooses at run time).
//
// Positions of a batch are one int64 base cell plus float offsets in cells, so that precision does not fade with the
// distance from the origin: keep offsets small (|offset| < 2^23; the position error is half an ulp of the offset).
// Results of a point do not depend on the other points of its batch. All spans of a call have equal length.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "noise/fbm.h"

namespace strata::noise {

template <std::size_t D>
struct Points {
    std::array<std::int64_t, D> base_cell{};
    std::array<std::span<const float>, D> offset;
};

template <std::size_t D>
struct GradientSpans {
    std::array<std::span<float>, D> axis;
};

// Second derivatives: 2-D xx, xy, yy; 3-D xx, yy, zz, xy, xz, yz.
template <std::size_t D>
struct HessianSpans {
    std::array<std::span<float>, D*(D + 1) / 2> entry;
};

void noise_value(const LatticeKey& key, const Points<2>& points, std::span<float> value);
void noise_value(const LatticeKey& key, const Points<3>& points, std::span<float> value);

void noise_gradient(const LatticeKey& key, const Points<2>& points, std::span<float> value,
                    const GradientSpans<2>& gradient);
void noise_gradient(const LatticeKey& key, const Points<3>& points, std::span<float> value,
                    const GradientSpans<3>& gradient);

void noise_hessian(const LatticeKey& key, const Points<2>& points, std::span<float> value,
                   const GradientSpans<2>& gradient, const HessianSpans<2>& hessian);
void noise_hessian(const LatticeKey& key, const Points<3>& points, std::span<float> value,
                   const GradientSpans<3>& gradient, const HessianSpans<3>& hessian);

// fBm at origin + offset, both in the units that octave frequencies refer to. The origin is split per octave in double;
// |frequency * offset| must stay below 2^23 cells, and the position is off by 2^-24 (3 |frequency * offset| + 2) cells
// at most on each axis. A sub-span of octaves gives their part of the sum. (The tracer, which needs each octave's slope
// along its ray and the amplitude that remains, evaluates octaves itself: trace/octave-inl.h on noise-inl.h.)
void fbm_value(std::span<const Octave> octaves, const std::array<double, 2>& origin,
               const std::array<std::span<const float>, 2>& offset, std::span<float> value);
void fbm_value(std::span<const Octave> octaves, const std::array<double, 3>& origin,
               const std::array<std::span<const float>, 3>& offset, std::span<float> value);

// The same values to the bit, with the sum's derivatives by position: those of an octave count a_k w_k and a_k w_k^2,
// rounded to float once, times the noise's own.
void fbm_gradient(std::span<const Octave> octaves, const std::array<double, 2>& origin,
                  const std::array<std::span<const float>, 2>& offset, std::span<float> value,
                  const GradientSpans<2>& gradient);
void fbm_gradient(std::span<const Octave> octaves, const std::array<double, 3>& origin,
                  const std::array<std::span<const float>, 3>& offset, std::span<float> value,
                  const GradientSpans<3>& gradient);

void fbm_hessian(std::span<const Octave> octaves, const std::array<double, 2>& origin,
                 const std::array<std::span<const float>, 2>& offset, std::span<float> value,
                 const GradientSpans<2>& gradient, const HessianSpans<2>& hessian);
void fbm_hessian(std::span<const Octave> octaves, const std::array<double, 3>& origin,
                 const std::array<std::span<const float>, 3>& offset, std::span<float> value,
                 const GradientSpans<3>& gradient, const HessianSpans<3>& hessian);

}  // namespace strata::noise
