// From 0 to `height` along a direction of the plan, by a smooth step over `width`: a mask by place, a slope, a step.
#ifndef STRATA_NOISE_RELIEF_RAMP_H_
#define STRATA_NOISE_RELIEF_RAMP_H_

#include <cmath>
#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Ramp {
    static constexpr std::string_view kType = "ramp";
    static constexpr std::string_view kMeaning = "a smooth rise along a direction of the plan: a mask by place";
    static constexpr int kFewestInputs = 0, kMostInputs = 0;
    static constexpr bool kPlaneOnly = true;

    double height = 1.0, azimuth_deg = 0.0, begin = 0.0, width = 10.0;

    template <class Keys>
    void keys(Keys& to) {
        to.number("height", height, -1e6, 1e6, "surface units", "what it rises to");
        to.number("azimuth_deg", azimuth_deg, -360.0, 360.0, "degrees from z towards x", "where it rises to");
        to.number("begin", begin, -1e9, 1e9, "surface units along that direction", "where it begins to rise");
        to.number("width", width, 1e-6, 1e9, "surface units", "over which it rises");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/steps-inl.h"
#if defined(STRATA_NOISE_RELIEF_RAMP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_RAMP_INL_H_
#undef STRATA_NOISE_RELIEF_RAMP_INL_H_
#else
#define STRATA_NOISE_RELIEF_RAMP_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Ramp& node, Numbers& a, const typename Numbers::Domain& at) {
    const double turn = node.azimuth_deg * (3.14159265358979323846 / 180.0), per = 1.0 / node.width;
    const auto along = a.along(at, per * std::sin(turn), per * std::cos(turn), -node.begin * per, false);
    return a.scaled(a.curved(SmoothStep{}, along), node.height);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
