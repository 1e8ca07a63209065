// Beds of rock: another relief whose heights are drawn towards steps, one every `step`. With f = r / step - floor,
//   r + strength step (3 f^2 - 2 f^3 - f),
// which keeps every step's height and the order of heights: the slope of the curve is 1 + strength (6 f - 6 f^2 - 1).
#ifndef STRATA_NOISE_RELIEF_TERRACES_H_
#define STRATA_NOISE_RELIEF_TERRACES_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Terraces {
    static constexpr std::string_view kType = "terraces";
    static constexpr std::string_view kMeaning = "another relief, its slopes stepped: beds of rock";
    static constexpr int kFewestInputs = 1, kMostInputs = 1;

    double step = 0.1, strength = 0.8;

    template <class Keys>
    void keys(Keys& to) {
        to.number("step", step, 1e-6, 1e6, "surface units", "height of a step");
        to.number("strength", strength, 0.0, 1.0, "", "how flat the treads are; 1: level");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/steps-inl.h"
#if defined(STRATA_NOISE_RELIEF_TERRACES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_TERRACES_INL_H_
#undef STRATA_NOISE_RELIEF_TERRACES_INL_H_
#else
#define STRATA_NOISE_RELIEF_TERRACES_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Terraces& node, Numbers& a, const typename Numbers::Domain& at) {
    return a.curved(TerraceCurve{node.step, node.strength}, a.input(0, at));
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
