// Billows: cushions with sharp seams between them, the ridges' counterpart. A multifractal
// (noise/relief/multifractal-inl.h) of the curve s = (sqrt(v^2 + roundness^2) - roundness) / m with m its value at
// v = 1, so that s lies in [0, 1].
#ifndef STRATA_NOISE_RELIEF_BILLOW_H_
#define STRATA_NOISE_RELIEF_BILLOW_H_

#include <cmath>
#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Billow {
    static constexpr std::string_view kType = "billow";
    static constexpr std::string_view kMeaning = "cushions with seams between them: clouds, boulders, hummocks";
    static constexpr int kFewestInputs = 0, kMostInputs = 0;

    FbmParameters parameters{.octaves = 6, .amplitude = 1.0, .frequency = 0.25};
    double roundness = 0.05;
    double feedback = 0.0;
    double turn_deg = 0.0;

    template <class Keys>
    void keys(Keys& to) {
        to.octaves(parameters);
        to.turn(turn_deg);
        to.number("roundness", roundness, 0.001, 0.9, "of the noise's largest value",
                  "how round the seams are; small is sharp and dear to trace");
        to.number("feedback", feedback, 0.0, 8.0, "",
                  "how far fine cushions keep to the tops of coarse ones; 0: everywhere alike");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return make_live_octaves(parameters); }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/multifractal-inl.h"
#if defined(STRATA_NOISE_RELIEF_BILLOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_BILLOW_INL_H_
#undef STRATA_NOISE_RELIEF_BILLOW_INL_H_
#else
#define STRATA_NOISE_RELIEF_BILLOW_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Billow& node, Numbers& a, const typename Numbers::Domain& at) {
    return multifractal(BillowCurve{node.roundness, 1.0 / (std::hypot(1.0, node.roundness) - node.roundness)},
                        node.feedback, a, at);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
