// Valleys filled level: what lies deeper than `floor` is filled up to it, softly. A lake's bed, a glacier, a plain.
#ifndef STRATA_NOISE_RELIEF_FILL_H_
#define STRATA_NOISE_RELIEF_FILL_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Fill {
    static constexpr std::string_view kType = "fill";
    static constexpr std::string_view kMeaning = "another relief, its valleys filled up to a floor";
    static constexpr int kFewestInputs = 1, kMostInputs = 1;

    double floor = 0.2;
    double softness = 0.1;

    template <class Keys>
    void keys(Keys& to) {
        to.number("floor", floor, -1e6, 1e6, "surface units", "height up to which valleys are filled");
        to.number("softness", softness, 1e-6, 1e6, "surface units", "height over which slopes turn into the floor");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/curves-inl.h"
#if defined(STRATA_NOISE_RELIEF_FILL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_FILL_INL_H_
#undef STRATA_NOISE_RELIEF_FILL_INL_H_
#else
#define STRATA_NOISE_RELIEF_FILL_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Fill& node, Numbers& a, const typename Numbers::Domain& at) {
    return a.curved(FillCurve{node.floor, node.softness}, a.input(0, at));
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
