// Craters: one at every corner c of a lattice, at c + j with a jitter |j_i| <= 1/4, of the radius R cells and the depth
// factor e by the corner's hash. At p in lattice units, with q = |p - c - j|^2 / R^2,
//
//   sum over corners of e R g(q),
//
// where g (kPitProfile) is a bowl of a nearly level floor, a rim at q = 1 and ejecta that end at q = kPitReach^2, so
// that g and g' vanish from there on. R <= kWidest gives a reach of kPitReach R < 0.6, and what is not one of a cell's
// own four corners is at least 3/4 away from all of its points: four corners are enough, and are all that count 0.15
// cells around, too.
//
// Bounds, with g's largest slopes and bends (found by the tests again on a dense grid): along the radius d = |p - c -
// j| the crater has the slope e R g' 2 d / R^2 = 2 e sqrt(q) g' and the second derivative e (2 g' + 4 q g'') / R,
// across it 2 e g' / R. No more than four craters are at one place. A point is in the bowls (q < 1, d < R <= 0.3) of
// two craters at most: corners of three are those of a triangle, two of which are 1/sqrt(2) apart at least, with 0.3 +
// 0.3 < 0.707. So the sum lies between 2 kWidest min g and 4 kWidest max g.
#pragma once

#include <array>
#include <cstdint>

#include "noise/hash.h"
#include "noise/relief/hermite.h"

namespace strata::noise {

inline constexpr double kNarrowest = 0.1, kWidest = 0.3;  // R, in cells
inline constexpr double kPitReach = 1.95;                 // in R
inline constexpr double kPitMargin = 0.15;                // in cells

// A simple crater's proportions, after R. J. Pike, "Depth/diameter relations of fresh lunar craters" (1974): 0.16 of
// its diameter deep below the rim.
inline constexpr std::array<HermiteKnot, 8> kPitKnots{{{0.0, -0.2630, 0.05},
                                                       {0.15, -0.2322, 0.36},
                                                       {0.88, 0.0306, 0.36},
                                                       {1.0, 0.0522, 0.0},
                                                       {1.15, 0.0458, -0.085},
                                                       {1.6, 0.0200, -0.038},
                                                       {2.4, 0.0055, -0.010},
                                                       {kPitReach * kPitReach, 0.0, 0.0}}};
inline constexpr HermiteTable kPitProfile = make_hermite(kPitKnots);

struct PitBounds {
    double low = -0.2631, high = 0.0523;      // of g
    double slope = 0.68;                      // of 2 sqrt(q) |g'|
    double bend_up = 1.96, bend_down = 12.1;  // of 2 g' and 2 g' + 4 q g'', and of what is opposite to them
};

struct Pit {
    double x, z;           // the jitter
    double radius, depth;  // R, and e
};

// A second round of hashing, for all bits of the word are used: a byte each for x, z, the radius and the depth.
constexpr std::uint32_t pit_bits(std::uint32_t combined_words) {
    std::uint32_t h = corner_hash(combined_words);
    h ^= h >> 15;
    return h * kAxisMultiplier;
}
inline constexpr double kPitByte = 1.0 / 255.0;

// Few are large and few are fresh: R grows with the square of a uniform number, and so does e from `worn` to 1.
constexpr Pit pit_of(std::uint32_t combined_words, double worn) {
    const std::uint32_t bits = pit_bits(combined_words);
    const auto part = [&](int shift) { return static_cast<double>((bits >> shift) & 255u) * kPitByte; };
    const double size = part(16), age = part(24);
    return {0.5 * part(0) - 0.25, 0.5 * part(8) - 0.25, kNarrowest + (kWidest - kNarrowest) * size * size,
            worn + (1.0 - worn) * age * age};
}

}  // namespace strata::noise
