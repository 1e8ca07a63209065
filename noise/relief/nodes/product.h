// scale times the product of other reliefs.
#ifndef STRATA_NOISE_RELIEF_PRODUCT_H_
#define STRATA_NOISE_RELIEF_PRODUCT_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Product {
    static constexpr std::string_view kType = "product";
    static constexpr std::string_view kMeaning = "other reliefs multiplied: one says how strong the others are where";
    static constexpr int kFewestInputs = 1, kMostInputs = 8;

    double scale = 1.0;

    template <class Keys>
    void keys(Keys& to) {
        to.number("scale", scale, -1e6, 1e6, "", "what the product is multiplied by");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#if defined(STRATA_NOISE_RELIEF_PRODUCT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_PRODUCT_INL_H_
#undef STRATA_NOISE_RELIEF_PRODUCT_INL_H_
#else
#define STRATA_NOISE_RELIEF_PRODUCT_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Product& node, Numbers& a, const typename Numbers::Domain& at) {
    auto all = a.scaled(a.input(0, at), node.scale);
    for (std::size_t i = 1; i < a.inputs(); ++i) all = a.product(all, a.input(i, at));
    return all;
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
