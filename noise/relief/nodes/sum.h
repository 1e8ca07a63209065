// offset + scale times the sum of other reliefs.
#ifndef STRATA_NOISE_RELIEF_SUM_H_
#define STRATA_NOISE_RELIEF_SUM_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Sum {
    static constexpr std::string_view kType = "sum";
    static constexpr std::string_view kMeaning = "other reliefs on top of one another";
    static constexpr int kFewestInputs = 1, kMostInputs = 8;

    double scale = 1.0;
    double offset = 0.0;

    template <class Keys>
    void keys(Keys& to) {
        to.number("scale", scale, -1e6, 1e6, "", "what the sum is multiplied by");
        to.number("offset", offset, -1e6, 1e6, "surface units", "what is added then");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#if defined(STRATA_NOISE_RELIEF_SUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_SUM_INL_H_
#undef STRATA_NOISE_RELIEF_SUM_INL_H_
#else
#define STRATA_NOISE_RELIEF_SUM_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Sum& node, Numbers& a, const typename Numbers::Domain& at) {
    auto sum = a.input(0, at);
    for (std::size_t i = 1; i < a.inputs(); ++i) sum = a.plus(sum, a.input(i, at));
    return a.plus(a.scaled(sum, node.scale), a.constant(node.offset));
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
