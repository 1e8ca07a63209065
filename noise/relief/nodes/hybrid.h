// Hybrid multifractal: rough heights over smooth valleys, without crests. A multifractal
// (noise/relief/multifractal-inl.h) of the curve s = (1 + v)^2 / 4.
#ifndef STRATA_NOISE_RELIEF_HYBRID_H_
#define STRATA_NOISE_RELIEF_HYBRID_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Hybrid {
    static constexpr std::string_view kType = "hybrid";
    static constexpr std::string_view kMeaning = "rough heights over smooth valleys, without crests";
    static constexpr int kFewestInputs = 0, kMostInputs = 0;

    FbmParameters parameters{.octaves = 6, .amplitude = 1.0, .frequency = 0.25};
    double feedback = 2.0;
    double turn_deg = 0.0;

    template <class Keys>
    void keys(Keys& to) {
        to.octaves(parameters);
        to.turn(turn_deg);
        to.number("feedback", feedback, 0.0, 8.0, "",
                  "how far fine octaves keep to where coarse ones are high; 0: everywhere alike");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return make_live_octaves(parameters); }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/multifractal-inl.h"
#if defined(STRATA_NOISE_RELIEF_HYBRID_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_HYBRID_INL_H_
#undef STRATA_NOISE_RELIEF_HYBRID_INL_H_
#else
#define STRATA_NOISE_RELIEF_HYBRID_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Hybrid& node, Numbers& a, const typename Numbers::Domain& at) {
    return multifractal(LiftCurve{}, node.feedback, a, at);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
