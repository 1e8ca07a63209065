// Puts a mass where it is wanted: r = (least + (1 - least) E) base + lift E with
//   E = 1 / (1 + ((x - x0) / x_size)^2 + ((z - z0) / z_size)^2)^2.
// Without a base it is the mass itself, lift E: a mound, or with one size far larger than the other a valley's axis.
#ifndef STRATA_NOISE_RELIEF_ENVELOPE_H_
#define STRATA_NOISE_RELIEF_ENVELOPE_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Envelope {
    static constexpr std::string_view kType = "envelope";
    static constexpr std::string_view kMeaning = "another relief, high at one place and low away from it; or a mound";
    static constexpr int kFewestInputs = 0, kMostInputs = 1;

    double x = 0.0, z = 0.0, x_size = 4.0, z_size = 4.0;
    double least = 0.3, lift = 0.0;

    template <class Keys>
    void keys(Keys& to) {
        to.number("x", x, -1e9, 1e9, "surface units", "where the mass is");
        to.number("z", z, -1e9, 1e9, "surface units", "where the mass is");
        to.number("x_size", x_size, 1e-6, 1e9, "surface units", "how far it reaches: a quarter is left there");
        to.number("z_size", z_size, 1e-6, 1e9, "surface units", "how far it reaches: a quarter is left there");
        to.number("least", least, 0.0, 1.0, "of the relief", "what is left of it far away");
        to.number("lift", lift, -1e6, 1e6, "surface units", "how much the mass is raised beside");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#if defined(STRATA_NOISE_RELIEF_ENVELOPE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_ENVELOPE_INL_H_
#undef STRATA_NOISE_RELIEF_ENVELOPE_INL_H_
#else
#define STRATA_NOISE_RELIEF_ENVELOPE_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Envelope& node, Numbers& a, const typename Numbers::Domain& at) {
    const auto mass = a.fall_off(at, node.x, node.z, 1.0 / node.x_size, 1.0 / node.z_size);
    if (a.inputs() == 0) return a.scaled(mass, node.lift);
    const auto weight = a.plus(a.constant(node.least), a.scaled(mass, 1.0 - node.least));
    return a.plus(a.product(weight, a.input(0, at)), a.scaled(mass, node.lift));
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
