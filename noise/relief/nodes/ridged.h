// Ridged multifractal: crests where noise crosses zero, quiet valleys. A multifractal (noise/relief/multifractal-inl.h)
// of the curve s = (1 - sqrt(v^2 + roundness^2))^2, whose crest is rounded.
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
    double turn_deg = 0.0;

    template <class Keys>
    void keys(Keys& to) {
        to.octaves(parameters);
        to.turn(turn_deg);
        to.number("roundness", roundness, 0.001, 0.9, "of the noise's largest value",
                  "how round crests are; small is sharp and dear to trace");
        to.number("feedback", feedback, 0.0, 8.0, "",
                  "how far fine crests keep to coarse ones: valleys are quiet; 0: everywhere alike");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return make_live_octaves(parameters); }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/multifractal-inl.h"
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
    return multifractal(RidgeCurve{node.roundness}, node.feedback, a, at);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
