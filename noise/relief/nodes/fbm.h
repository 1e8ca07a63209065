// fBm as a relief: the sum over octaves k of amplitude gain^k n(frequency lacunarity^k x).
#ifndef STRATA_NOISE_RELIEF_FBM_H_
#define STRATA_NOISE_RELIEF_FBM_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Fbm {
    static constexpr std::string_view kType = "fbm";
    static constexpr std::string_view kMeaning = "a sum of octaves of noise: rolling hills";
    static constexpr int kFewestInputs = 0, kMostInputs = 0;

    FbmParameters parameters{.amplitude = 0.6, .frequency = 0.5};
    double turn_deg = 0.0;

    template <class Keys>
    void keys(Keys& to) {
        to.octaves(parameters);
        to.turn(turn_deg);
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return make_live_octaves(parameters); }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#if defined(STRATA_NOISE_RELIEF_FBM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_FBM_INL_H_
#undef STRATA_NOISE_RELIEF_FBM_INL_H_
#else
#define STRATA_NOISE_RELIEF_FBM_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Fbm&, Numbers& a, const typename Numbers::Domain& at) {
    auto sum = a.begin_sum();
    for (std::size_t k = 0; k < a.octaves(); ++k) {
        if (!a.sees(sum, k, at, -a.amplitude_from(k) * a.peak(), a.amplitude_from(k) * a.peak())) break;
        a.add(sum, a.octave(k, at, a.amplitude(k)));
    }
    return a.total(sum);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
