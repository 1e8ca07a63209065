// Another relief read elsewhere: r(x + u(x)), each component of u an fBm of its own, its octaves' noise over its
// largest value times amplitude gain^k. Lattice lines and straight crests become winding ones. Over 2-D noise u has the
// components x and z.
#ifndef STRATA_NOISE_RELIEF_WARP_H_
#define STRATA_NOISE_RELIEF_WARP_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Warp {
    static constexpr std::string_view kType = "warp";
    static constexpr std::string_view kMeaning = "another relief, its plan bent by noise: winding crests";
    static constexpr int kFewestInputs = 1, kMostInputs = 1;

    FbmParameters parameters{.octaves = 1, .amplitude = 0.3, .frequency = 0.2, .seed = 101};

    template <class Keys>
    void keys(Keys& to) {
        to.octaves(parameters);
    }

    // Those of the first component, then those of the next ones.
    std::vector<Octave> octaves(int dimensions) const {
        constexpr std::uint64_t kStream = 0x9E3779B97F4A7C15u;
        std::vector<Octave> all;
        for (int component = 0; component < dimensions; ++component) {
            FbmParameters of_component = parameters;
            of_component.seed ^= kStream * static_cast<std::uint64_t>(component + 1);
            for (const Octave& octave : make_live_octaves(of_component)) all.push_back(octave);
        }
        return all;
    }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#if defined(STRATA_NOISE_RELIEF_WARP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_WARP_INL_H_
#undef STRATA_NOISE_RELIEF_WARP_INL_H_
#else
#define STRATA_NOISE_RELIEF_WARP_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

// The displacement is evaluated in full: what is left out of it would blur the relief that is read there.
template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Warp&, Numbers& a, const typename Numbers::Domain& at) {
    const std::size_t each = a.octaves() / a.dimensions();
    typename Numbers::Displacement u = a.no_displacement();
    for (std::size_t component = 0; component < a.dimensions(); ++component) {
        for (std::size_t k = 0; k < each; ++k) {
            const std::size_t octave = component * each + k;
            u[component] = a.plus(u[component], a.scaled(a.octave(octave, at), a.amplitude(octave) / a.peak()));
        }
    }
    return a.input(0, a.displaced(at, u));
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
