// Dunes: a train of waves with a gentle windward side, a brink and a slip face, its crests bent by noise:
//
//   r = height (1 - vary (1 - n_A) / 2) P(phi),   phi = (x sin azimuth + z cos azimuth) / wavelength + winding sum_k
//   gain^k n_k.
//
// Here n_k and n_A are octaves of noise over their largest values: those of the winding, the first with one cell in
// `winding_size`, and one that makes some dunes lower. P has the period 1 and values in [0, 1] (dune_profile below).
// The wind blows towards azimuth. Where crests crowd, slip faces are steeper than on the straight train: by the
// certificate's slope, which `strata explain` prints, nowhere more than that.
#ifndef STRATA_NOISE_RELIEF_DUNES_H_
#define STRATA_NOISE_RELIEF_DUNES_H_

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "noise/fbm.h"
#include "noise/relief/hermite.h"

namespace strata::noise {

// The profile over one wavelength. Windward, with a the way up the windward side, a^2 (1.9 - 0.9 a); the slip face is
// straight and ends in a parabola over 2/5 of its width. The brink is rounded by a parabola over `brink` on either
// side, below the point where both sides would meet. Its knots are exact for all but the windward side's cubic, which
// is one, too.
constexpr HermiteTable dune_profile(double lee, double brink) {
    const double windward = 1.0 - lee, foot = 0.4 * lee, half = 0.5 * brink;
    const double a = (windward - brink) / windward;
    const double before = a * a * (1.9 - 0.9 * a), rise = a * (3.8 - 2.7 * a) / windward;
    const double top = before + half * rise, fall = top / (lee - half - 0.5 * foot);
    const std::array<HermiteKnot, 6> knots{{{0.0, 0.0, 0.0},
                                            {windward - brink, before / top, rise / top},
                                            {windward, 1.0, 0.0},
                                            {windward + brink, 1.0 - half * fall / top, -fall / top},
                                            {1.0 - foot, 0.5 * foot * fall / top, -fall / top},
                                            {1.0, 0.0, 0.0}}};
    return make_hermite(knots);
}

struct Dunes {
    static constexpr std::string_view kType = "dunes";
    static constexpr std::string_view kMeaning = "a train of dunes with brinks and slip faces, or ripples";
    static constexpr int kFewestInputs = 0, kMostInputs = 0;
    static constexpr bool kPlaneOnly = true;

    double wavelength = 2.0, height = 0.25, azimuth_deg = 60.0, lee = 0.3, brink = 0.02;
    double winding = 0.8, winding_size = 6.0, vary = 0.6;
    FbmParameters parameters{.octaves = 2, .lacunarity = 2.5, .gain = 0.4};
    HermiteTable table{};

    template <class Keys>
    void keys(Keys& to) {
        to.number("wavelength", wavelength, 1e-6, 1e6, "surface units", "from crest to crest");
        to.number("height", height, 0.0, 1e6, "surface units", "of the highest dunes");
        to.number("azimuth_deg", azimuth_deg, -360.0, 360.0, "degrees from z towards x", "where the wind blows to");
        to.number("lee", lee, 0.1, 0.9, "of the wavelength", "width of the slip face");
        to.number("brink", brink, 0.001, 0.05, "of the wavelength", "how round the crest is; small is sharp");
        to.number("winding", winding, 0.0, 10.0, "wavelengths", "how far crests are bent");
        to.number("winding_size", winding_size, 1e-6, 1e9, "surface units", "over which they bend");
        to.count("octaves", parameters.octaves, 1, 8, "bends, each finer");
        to.number("lacunarity", parameters.lacunarity, 1.0, 10.0, "", "size ratio of neighbouring bends");
        to.number("gain", parameters.gain, 0.0, 1.0, "", "amplitude ratio of neighbouring bends");
        to.number("vary", vary, 0.0, 1.0, "of the height", "how much lower the lowest dunes are");
        to.seed("seed", parameters.seed, "chooses the bends");
    }

    void prepare() { table = dune_profile(lee, brink); }

    // Trains of dunes a unit, of which a place in double has to tell which it is in.
    double repeats() const { return 1.0 / wavelength; }

    // Those of the bends, then the one of the height, whose cells are half as large as the first bend's.
    std::vector<Octave> octaves(int /*dimensions*/) const {
        constexpr std::uint64_t kHeightStream = 0xA0761D6478BD642Fu;
        FbmParameters bends = parameters, heights = parameters;
        bends.amplitude = winding;
        bends.frequency = 1.0 / winding_size;
        heights.octaves = 1;
        heights.amplitude = 1.0;
        heights.frequency = 2.0 / winding_size;
        heights.seed ^= kHeightStream;
        std::vector<Octave> all = make_octaves(bends);
        all.push_back(make_octaves(heights).front());
        return all;
    }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/hermite-inl.h"
#if defined(STRATA_NOISE_RELIEF_DUNES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_DUNES_INL_H_
#undef STRATA_NOISE_RELIEF_DUNES_INL_H_
#else
#define STRATA_NOISE_RELIEF_DUNES_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Dunes& node, Numbers& a, const typename Numbers::Domain& at) {
    auto sum = a.begin_sum();
    const double per = 1.0 / node.wavelength, turn = node.azimuth_deg * (3.14159265358979323846 / 180.0);
    if (!a.sees_cells(sum, per, at, 0.0, node.height)) return a.total(sum);
    const std::size_t last = a.octaves() - 1;
    auto phase = a.along(at, per * std::sin(turn), per * std::cos(turn), 0.0, true);
    for (std::size_t k = 0; k < last; ++k) {
        phase = a.plus(phase, a.octave(k, at, a.amplitude(k) / a.peak()));
    }
    const auto profile = a.curved(PeriodicCurve{{node.table}}, phase);
    const double swing = 0.5 * node.vary * node.height;
    const auto height = a.plus(a.constant(node.height - swing), a.scaled(a.octave(last, at), swing / a.peak()));
    a.add(sum, a.part_of(height, profile));
    return a.total(sum);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
