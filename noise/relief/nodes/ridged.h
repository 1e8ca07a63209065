// Ridged multifractal: crests where noise crosses zero, quiet valleys. With v_k octave k's noise over its largest
// value,
//
//   s_k = (1 - sqrt(v_k^2 + roundness^2))^2,   w_0 = 1,   w_{k+1} = clip(feedback w_k s_k),
//   r = amplitude sum over k of gain^k w_k s_k,      0 <= r <= amplitude sum of gain^k,
//
// after F. K. Musgrave's ridged multifractal (in Ebert et al., "Texturing and Modeling"), with a rounded crest and a
// clip without a kink, so that the gradient is continuous. feedback = 0: all weights are 1.
#ifndef STRATA_NOISE_RELIEF_RIDGED_H_
#define STRATA_NOISE_RELIEF_RIDGED_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Ridged {
    static constexpr std::string_view kType = "ridged";
    static constexpr std::string_view kMeaning = "mountain crests over quiet valleys";
    static constexpr int kFewestInputs = 0, kMostInputs = 0;

    FbmParameters parameters{.octaves = 6, .amplitude = 1.0, .frequency = 0.25};
    double roundness = 0.05;
    double feedback = 1.5;

    template <class Keys>
    void keys(Keys& to) {
        to.octaves(parameters);
        to.number("roundness", roundness, 0.001, 0.9, "of the noise's largest value",
                  "how round crests are; small is sharp and dear to trace");
        to.number("feedback", feedback, 0.0, 8.0, "",
                  "how far fine crests keep to coarse ones: valleys are quiet; 0: everywhere alike");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return make_octaves(parameters); }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/curves-inl.h"
#if defined(STRATA_NOISE_RELIEF_RIDGED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_RIDGED_INL_H_
#undef STRATA_NOISE_RELIEF_RIDGED_INL_H_
#else
#define STRATA_NOISE_RELIEF_RIDGED_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Ridged& node, Numbers& a, const typename Numbers::Domain& at) {
    const RidgeCurve ridge{node.roundness};
    auto sum = a.begin_sum();
    auto weight = a.constant(1.0);
    for (std::size_t k = 0; k < a.octaves(); ++k) {
        if (!a.sees(sum, k, at, 0.0, a.amplitude_from(k))) break;
        auto term = a.curved(ridge, a.scaled(a.octave(k, at), 1.0 / a.peak()));
        if (node.feedback > 0.0) {
            term = a.product(weight, term);
            weight = a.curved(SoftClip{}, a.scaled(term, node.feedback));
        }
        a.add(sum, a.scaled(term, a.amplitude(k)));
    }
    return a.total(sum);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
