// The higher of two reliefs a and b, rounded where they meet:
//   (a + b + sqrt((a - b)^2 + softness^2)) / 2, by which it lies up to softness / 2 above both.
#ifndef STRATA_NOISE_RELIEF_HIGHEST_H_
#define STRATA_NOISE_RELIEF_HIGHEST_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Highest {
    static constexpr std::string_view kType = "highest";
    static constexpr std::string_view kMeaning = "whichever of two reliefs is higher: one stands on another";
    static constexpr int kFewestInputs = 2, kMostInputs = 2;

    double softness = 0.05;

    template <class Keys>
    void keys(Keys& to) {
        to.number("softness", softness, 1e-6, 1e6, "surface units", "how round the seam is; small is sharp");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#if defined(STRATA_NOISE_RELIEF_HIGHEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_HIGHEST_INL_H_
#undef STRATA_NOISE_RELIEF_HIGHEST_INL_H_
#else
#define STRATA_NOISE_RELIEF_HIGHEST_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Highest& node, Numbers& a, const typename Numbers::Domain& at) {
    return a.highest(a.input(0, at), a.input(1, at), node.softness);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
