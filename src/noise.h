// Gradient noise and fBm in batches, with derivatives and with certificates of how large and how exact they are.
// Installed as <strata/noise.h>; link Strata::noise. It needs nothing of the renderer.
//
//   noise   n(p) in lattice units: Perlin's of 2002 with the quintic fade, an int64 cell index on each axis that has no
//           period, twelve edge gradients in 3-D and eight directions in 2-D (K. Perlin, "Improving Noise", 2002; the
//           hash is noise/hash.h's in the sources). It is zero at all corners of the lattice and twice continuously
//           differentiable.
//   fBm     F(x) = sum over k of a_k n_k(w_k x + o_k), a_k = amplitude gain^k, w_k = frequency lacunarity^k, where each
//           octave k has a lattice and an offset o_k of its own
//
// Coordinates are a whole part in int64 or double for the batch and a float offset from it for each point, so that
// precision does not fade with the distance from the origin. Results are floats.
//
// A batch is spans of equal length, one a coordinate: element i of each belongs to point i. Outputs may not overlap
// inputs or each other. A point's results do not depend on the rest of its batch, and are the same bits on one
// SIMD target (below); across targets they differ within Rounding. Spans of unlike length are a strata::Error; points
// out of the stated range are not looked for, and theirs are the only results that suffer.
//
// All functions may be called from several threads at once, but for use_simd_target().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"

namespace strata {

// Points of D coordinates, 2 or 3, each `cell` + `offset`, in lattice units. |cell| <= 2^62, |offset| < 2^23; a point
// is where its offset is to half an ulp of it.
template <std::size_t D>
struct NoisePoints {
    std::array<std::int64_t, D> cell{};
    std::array<std::span<const float>, D> offset;
};

// Points `origin` + `offset`, in the units that an fBm's frequency refers to. |w_k origin| < 2^51 and
// |w_k offset| < 2^23 for the greatest w_k.
template <std::size_t D>
struct FbmPoints {
    std::array<double, D> origin{};
    std::array<std::span<const float>, D> offset;
};

// First derivatives, an axis each.
template <std::size_t D>
struct Gradients {
    std::array<std::span<float>, D> axis;
};

// Second derivatives: in 2-D xx, xy, yy; in 3-D xx, yy, zz, xy, xz, yz.
template <std::size_t D>
struct Hessians {
    std::array<std::span<float>, D*(D + 1) / 2> entry;
};

// Certificate of size: no point of any lattice exceeds these, in exact arithmetic. Proved by branch and bound over all
// positions, directions and corner gradients; within 1e-4 of the maxima for noise, the octaves' sums for fBm.
// Derivatives are by the caller's coordinates.
struct Bounds {
    double value;     // |n|
    double gradient;  // the gradient's length: the Lipschitz constant
    double second;    // |d^2/ds^2| along any straight line: the largest eigenvalue of the Hessian
    double third;     // |d^3/ds^3| along any straight line, from either side where it jumps
};

// Certificate of exactness: by how much a returned float may differ from exact arithmetic at the point as it was given.
// On every SIMD target; a branch-and-bound running error analysis.
struct Rounding {
    double value;
    double gradient;  // of each component
    double hessian;   // of each entry
};

// One lattice of gradient noise; D is 2 or 3.
template <std::size_t D>
class Noise {
  public:
    // Another seed, any, is another lattice. It is octave 0 of the fBm of the same seed, but for its offset.
    explicit Noise(std::uint64_t seed = 1);

    void values(const NoisePoints<D>& points, std::span<float> value) const;

    // The same values to the bit, with derivatives by position.
    void gradients(const NoisePoints<D>& points, std::span<float> value, const Gradients<D>& gradient) const;
    void hessians(const NoisePoints<D>& points, std::span<float> value, const Gradients<D>& gradient,
                  const Hessians<D>& hessian) const;

    static Bounds bounds();

    // Against the point cell + offset as it is given.
    static Rounding rounding();

  private:
    std::array<std::uint32_t, 3> key_;
};

struct FbmParameters {
    int octaves = 8;          // 1 to 32
    double lacunarity = 2.0;  // ratio of neighbouring frequencies, > 0
    double gain = 0.5;        // ratio of neighbouring amplitudes, finite
    double amplitude = 1.0;   // a_0, finite
    double frequency = 1.0;   // w_0 in lattice cells a unit, > 0
    std::uint64_t seed = 1;   // any
};

// A sum of octaves; D is 2 or 3.
template <std::size_t D>
class Fbm {
  public:
    // Throws Error for parameters out of range, and where an octave's frequency is not in [1e-30, 1e15] or one of its
    // |a_k|, |a_k| w_k, |a_k| w_k^2 exceeds 1e30.
    explicit Fbm(const FbmParameters& parameters = {});
    ~Fbm();
    Fbm(const Fbm& other);
    Fbm& operator=(const Fbm& other);
    Fbm(Fbm&& other) noexcept;
    Fbm& operator=(Fbm&& other) noexcept;

    const FbmParameters& parameters() const;

    // Throw Error for an origin out of range, too.
    void values(const FbmPoints<D>& points, std::span<float> value) const;

    // The same values to the bit, with derivatives by position.
    void gradients(const FbmPoints<D>& points, std::span<float> value, const Gradients<D>& gradient) const;
    void hessians(const FbmPoints<D>& points, std::span<float> value, const Gradients<D>& gradient,
                  const Hessians<D>& hessian) const;

    Bounds bounds() const;

    // Of points whose origin and offsets are at most so large on each axis. Grows with both: what a place is rounded
    // by, the sum changes at most by bounds().gradient times as much.
    Rounding rounding(double largest_origin, double largest_offset) const;

  private:
    struct Octaves;
    std::unique_ptr<Octaves> octaves_;
};

extern template class Noise<2>;
extern template class Noise<3>;
extern template class Fbm<2>;
extern template class Fbm<3>;

// The SIMD targets that this machine runs, best first, of "avx512", "avx2", "sse4" and "scalar".
std::vector<std::string> simd_targets();

// The one in use: the best, unless another was chosen.
std::string simd_target();

// From now on uses one of simd_targets(), in the whole process: noise, pictures and all else that uses Highway. Throws
// Error for another name. Not to be called while other threads are in the library.
void use_simd_target(std::string_view name);

}  // namespace strata
