// Fractional Brownian motion: a sum of octaves of gradient noise,
//
//   sum_k a_k n_k(w_k x + o_k),   a_k = amplitude * gain^k,   w_k = frequency * lacunarity^k,   k = 0 .. octaves-1,
//
// where each octave has its own lattice key and its own offset o_k in [0,1)^3, so that no two line up at the origin.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "noise/hash.h"

namespace strata::noise {

inline constexpr int kMaxOctaves = 32;

struct FbmParameters {
    int octaves = 8;  // 1..32
    double lacunarity = 2.0;
    double gain = 0.5;
    double amplitude = 1.0;
    double frequency = 1.0;
    std::uint64_t seed = 1;
};

struct Octave {
    double amplitude = 0.0;  // a_k
    double frequency = 0.0;  // w_k
    std::array<double, 3> offset{};
    LatticeKey key;
};

// The octaves of `parameters`, coarsest first. a_k and w_k by repeated multiplication in double.
std::vector<Octave> make_octaves(const FbmParameters& parameters);

// The same without those at the end whose amplitude is 0, though not without the first. Their frequencies may lie
// beyond what a position can be told in.
std::vector<Octave> make_live_octaves(const FbmParameters& parameters);

}  // namespace strata::noise
