// Craters of many sizes: octaves of craters (noise/relief/pits.h), a crater a lattice cell, each with cells smaller by
// `lacunarity`: r = sum over k of depth size_k pits(p / size_k), size_k = size / lacunarity^k. A crater is 0.2 to 0.6
// of its cell wide, small ones are more frequent, most are worn.
#ifndef STRATA_NOISE_RELIEF_CRATERS_H_
#define STRATA_NOISE_RELIEF_CRATERS_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Craters {
    static constexpr std::string_view kType = "craters";
    static constexpr std::string_view kMeaning = "craters of many sizes, few fresh, most worn";
    static constexpr int kFewestInputs = 0, kMostInputs = 0;
    static constexpr bool kPlaneOnly = true;

    FbmParameters parameters{.octaves = 5, .lacunarity = 1.9, .gain = 1.0, .amplitude = 1.0};
    double size = 4.0, worn = 0.12;

    template <class Keys>
    void keys(Keys& to) {
        to.count("octaves", parameters.octaves, 1, 16, "sizes of craters");
        to.number("size", size, 1e-9, 1e9, "surface units", "of the largest craters' cells: they are up to 0.6 of it");
        to.number("depth", parameters.amplitude, 0.0, 4.0, "", "1: fresh craters are 0.16 of their diameter deep");
        to.number("gain", parameters.gain, 0.0, 1.0, "", "depth ratio of neighbouring sizes");
        to.number("lacunarity", parameters.lacunarity, 1.0, 10.0, "", "size ratio of neighbouring sizes");
        to.number("worn", worn, 0.0, 1.0, "of a fresh one's depth", "depth of the oldest craters");
        to.seed("seed", parameters.seed, "chooses the craters");
    }

    // Amplitudes are depth times the cells' sizes.
    std::vector<Octave> octaves(int /*dimensions*/) const {
        FbmParameters p = parameters;
        p.amplitude = parameters.amplitude * size;
        p.gain = parameters.gain / parameters.lacunarity;
        p.frequency = 1.0 / size;
        return make_octaves(p);
    }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/pits.h"
#if defined(STRATA_NOISE_RELIEF_CRATERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_CRATERS_INL_H_
#undef STRATA_NOISE_RELIEF_CRATERS_INL_H_
#else
#define STRATA_NOISE_RELIEF_CRATERS_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Craters& node, Numbers& a, const typename Numbers::Domain& at) {
    constexpr PitBounds of;
    auto sum = a.begin_sum();
    for (std::size_t k = 0; k < a.octaves(); ++k) {
        const double rest = a.amplitude_from(k) * kWidest;
        // In twice as fine cells than there are: balls are then within the margin that pits() has.
        if (!a.sees_cells(sum, 2.0 * a.frequency(k), at, 2.0 * of.low * rest, 4.0 * of.high * rest)) break;
        a.add(sum, a.scaled(a.pits(k, at, node.worn), a.amplitude(k)));
    }
    return a.total(sum);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
