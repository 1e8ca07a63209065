// From one relief to another as a third one, the mask, goes from `from` to `to`: (1 - s) a + s b with the smooth step s
// of the mask. Of two inputs the last is the mask and a is 0: a part of the plan is cut out.
#ifndef STRATA_NOISE_RELIEF_BLEND_H_
#define STRATA_NOISE_RELIEF_BLEND_H_

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Blend {
    static constexpr std::string_view kType = "blend";
    static constexpr std::string_view kMeaning = "one relief or nothing, then another, where a third rises: masks";
    static constexpr int kFewestInputs = 2, kMostInputs = 3;

    double from = 0.0, to = 1.0;

    template <class Keys>
    void keys(Keys& to_list) {
        to_list.number("from", from, -1e6, 1e6, "of the mask, which is named last", "where the first relief ends");
        to_list.number("to", to, -1e6, 1e6, "of the mask", "where the second has taken over; may be below from");
    }

    // Closer together, the mask's rounding in float would be all of it.
    std::string problem() const {
        const double apart = std::abs(to - from), size = std::max(std::abs(from), std::abs(to));
        return apart >= 1e-5 * size && apart > 0.0 ? "" : "from and to are nearer than 1e-5 of their size";
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/steps-inl.h"
#if defined(STRATA_NOISE_RELIEF_BLEND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_BLEND_INL_H_
#undef STRATA_NOISE_RELIEF_BLEND_INL_H_
#else
#define STRATA_NOISE_RELIEF_BLEND_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Blend& node, Numbers& a, const typename Numbers::Domain& at) {
    const double per = 1.0 / (node.to - node.from);
    const std::size_t mask = a.inputs() - 1;
    const auto ramp = a.plus(a.scaled(a.input(mask, at), per), a.constant(-node.from * per));
    const auto share = a.curved(SmoothStep{}, ramp);
    const auto first = mask == 2 ? a.input(0, at) : a.constant(0.0);
    return a.mixed(first, a.input(mask - 1, at), share);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
