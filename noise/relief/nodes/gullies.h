// Gullies that run down the slopes of another relief, and carve only: with G the slope (by differences over a small
// step, then that of what is carved so far), d = (-G_z, G_x) / sqrt(|G|^2 + c^2) the direction across the fall line,
// and C + i S octave k's stripe (noise/relief/stripe.h) along d,
//
//   r = base - sum over k of a_k q_k,   q_k = (1 - C / sqrt(C^2 + S^2 + e^2)) / 2,
//   a_k = depth size gain^k m clip(|G| / m),
//   G <- G - branching pi bands / size_k a_k S / sqrt(C^2 + S^2 + e^2) d,
//
// A second input, where there is one, guides them: G is its slope then. A smooth guide is cheaper to trace by far.
// There m is `steepest`, size_k = size / lacunarity^k, |G| is taken as sqrt(|G|^2 + c^2) - c and clip is without a
// kink. So r never exceeds the base, and a ray far above skips every stripe.
#ifndef STRATA_NOISE_RELIEF_GULLIES_H_
#define STRATA_NOISE_RELIEF_GULLIES_H_

#include <string_view>
#include <vector>

#include "noise/fbm.h"

namespace strata::noise {

struct Gullies {
    static constexpr std::string_view kType = "gullies";
    static constexpr std::string_view kMeaning = "another relief with gullies carved down its slopes, as by water";
    static constexpr int kFewestInputs = 1, kMostInputs = 2;
    static constexpr bool kPlaneOnly = true;  // its slopes are those of a height field

    // Its slope is that of differences: at a point and at one beside it on either axis.
    static constexpr std::size_t kReadsOfLastInput = 3;

    // c, e, and the step of the differences in sizes of the first octave.
    static constexpr double kFlat = 0.08, kEven = 0.25, kStep = 0.15;

    FbmParameters parameters{.octaves = 5, .lacunarity = 1.9, .gain = 0.5, .amplitude = 0.15, .frequency = 1.0};
    double size = 0.6, bands = 1.1, steepest = 1.2, branching = 1.0;

    template <class Keys>
    void keys(Keys& to) {
        to.count("octaves", parameters.octaves, 1, 10, "generations of gullies, each finer");
        to.number("size", size, 1e-9, 1e9, "surface units", "of the largest gullies' cells");
        to.number("depth", parameters.amplitude, 0.0, 2.0, "of size, on a slope of 45 degrees", "how deep they are");
        to.number("gain", parameters.gain, 0.0, 1.0, "", "depth ratio of neighbouring generations");
        to.number("lacunarity", parameters.lacunarity, 1.0, 10.0, "", "size ratio of neighbouring generations");
        to.number("bands", bands, 0.1, 4.0, "a cell", "how many gullies lie side by side");
        to.number("steepest", steepest, 0.05, 10.0, "slope", "beyond it gullies deepen no more");
        to.number("branching", branching, 0.0, 1.0, "", "how far fine gullies run into coarse ones; little is cheap");
        to.seed("seed", parameters.seed, "chooses the gullies");
    }

    std::vector<Octave> octaves(int /*dimensions*/) const {
        FbmParameters p = parameters;
        p.amplitude = parameters.amplitude * size;
        p.frequency = 1.0 / size;
        return make_octaves(p);
    }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/curves-inl.h"
#if defined(STRATA_NOISE_RELIEF_GULLIES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_GULLIES_INL_H_
#undef STRATA_NOISE_RELIEF_GULLIES_INL_H_
#else
#define STRATA_NOISE_RELIEF_GULLIES_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Gullies& node, Numbers& a, const typename Numbers::Domain& at) {
    const auto base = a.input(0, at);
    auto carved = a.begin_sum();
    if (!a.sees_stripe(carved, 0, at, -a.amplitude_from(0) * node.steepest, 0.0)) return a.plus(base, a.total(carved));
    const double step = Gullies::kStep * node.size;
    const std::size_t guide = a.inputs() - 1;
    const auto from = a.scaled(guide == 0 ? base : a.input(guide, at), -1.0 / step);
    auto slope_x = a.plus(a.scaled(a.input(guide, a.shifted(at, 0, step)), 1.0 / step), from);
    auto slope_z = a.plus(a.scaled(a.input(guide, a.shifted(at, 1, step)), 1.0 / step), from);
    for (std::size_t k = 0; k < a.octaves(); ++k) {
        if (!a.sees_stripe(carved, k, at, -a.amplitude_from(k) * node.steepest, 0.0)) break;
        const auto steep = a.norm(slope_x, slope_z, Gullies::kFlat);
        const auto depth = a.scaled(a.curved(SoftClip{1.0 / node.steepest}, steep), node.steepest * a.amplitude(k));
        const auto [across_x, across_z] = a.unit(a.scaled(slope_z, -1.0), slope_x, Gullies::kFlat);
        const auto [wave_c, wave_s] = a.stripe(k, at, across_x, across_z, node.bands);
        const auto [even_c, even_s] = a.unit(wave_c, wave_s, Gullies::kEven);
        const auto share = a.plus(a.constant(0.5), a.scaled(even_c, -0.5));
        a.add(carved, a.scaled(a.part_of(depth, share), -1.0));
        if (node.branching == 0.0) continue;
        const double turn = -3.14159265358979323846 * node.branching * node.bands * a.frequency(k);
        const auto pull = a.scaled(a.product(depth, even_s), turn);
        slope_x = a.plus(slope_x, a.product(pull, across_x));
        slope_z = a.plus(slope_z, a.product(pull, across_z));
    }
    return a.plus(base, a.total(carved));
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
