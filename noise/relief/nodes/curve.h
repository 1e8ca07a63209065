// A height curve: what lies at the heights `from` in another relief is brought to the heights `to`. Between these
// points the curve is cubic, rises where they rise, falls where they fall (noise/relief/hermite.h), and is straight
// beyond them. Terraces, mesas, a canyon's walls, a beach: flat stretches are ground, steep ones cliffs. Detail that
// the other relief has shifts the cliffs sideways.
#ifndef STRATA_NOISE_RELIEF_CURVE_H_
#define STRATA_NOISE_RELIEF_CURVE_H_

#include <string>
#include <string_view>
#include <vector>

#include "noise/fbm.h"
#include "noise/relief/hermite.h"

namespace strata::noise {

struct Curve {
    static constexpr std::string_view kType = "curve";
    static constexpr std::string_view kMeaning = "another relief, its heights sent through a curve: cliffs and ledges";
    static constexpr int kFewestInputs = 1, kMostInputs = 1;

    std::vector<double> from{-0.5, 0.0, 0.1, 0.5}, to{-0.3, 0.0, 0.4, 0.6};
    HermiteTable table{};

    template <class Keys>
    void keys(Keys& to_list) {
        to_list.numbers("from", from, -1e6, 1e6, "surface units", "heights of the other relief, increasing");
        to_list.numbers("to", to, -1e6, 1e6, "surface units", "the heights they become, as many");
    }

    std::string problem() const {
        if (from.size() != to.size()) return "from and to differ in number";
        if (from.size() < 2 || from.size() > HermiteTable::kMostKnots) return "from: 2 to 16 numbers are allowed";
        for (std::size_t i = 1; i < from.size(); ++i) {
            if (!(static_cast<float>(from[i]) > static_cast<float>(from[i - 1]))) return "from: not increasing";
        }
        return {};
    }

    void prepare() {
        if (!problem().empty()) return;
        std::vector<HermiteKnot> knots;
        // The pieces begin at floats: slopes are chosen for the curve that is drawn.
        for (std::size_t i = 0; i < from.size(); ++i) knots.push_back({static_cast<float>(from[i]), to[i], 0.0});
        set_monotone_slopes(knots);
        table = make_hermite(knots);
    }

    std::vector<Octave> octaves(int /*dimensions*/) const { return {}; }
};

}  // namespace strata::noise
#endif

#ifdef STRATA_RELIEF_FORMULAS
#include "noise/relief/hermite-inl.h"
#if defined(STRATA_NOISE_RELIEF_CURVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_CURVE_INL_H_
#undef STRATA_NOISE_RELIEF_CURVE_INL_H_
#else
#define STRATA_NOISE_RELIEF_CURVE_INL_H_
#endif
HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

template <class Numbers>
HWY_INLINE typename Numbers::Number relief_of(const Curve& node, Numbers& a, const typename Numbers::Domain& at) {
    return a.curved(HermiteCurve{node.table}, a.input(0, at));
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
