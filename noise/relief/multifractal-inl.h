// Sums of octaves that weigh one another: with v_k octave k's noise over its largest value and g a curve on [-1, 1]
// with values in [0, 1],
//
//   s_k = g(v_k),   w_0 = 1,   w_{k+1} = clip(feedback w_k s_k),   r = sum over k of a_k w_k s_k,
//   0 <= r <= sum of a_k;   feedback = 0: all weights are 1.
//
// As clip(u) <= u and s_k <= 1, w_j <= feedback^(j - k) w_k for j > k: where weights are low little is left to come,
// and octaves are left out sooner than those of a plain sum.
//
// After F. K. Musgrave's multifractals (in Ebert et al., "Texturing and Modeling"), with a clip without a kink, so that
// the gradient is continuous. Include after hwy/highway.h.
#if defined(STRATA_NOISE_RELIEF_MULTIFRACTAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STRATA_NOISE_RELIEF_MULTIFRACTAL_INL_H_
#undef STRATA_NOISE_RELIEF_MULTIFRACTAL_INL_H_
#else
#define STRATA_NOISE_RELIEF_MULTIFRACTAL_INL_H_
#endif

#include "noise/relief/curves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::noise::HWY_NAMESPACE {

// The largest sum of octave k and all after it, in weights w_k.
template <class Numbers>
double amplitude_by_weight(double feedback, const Numbers& a, std::size_t k) {
    double sum = 0.0, growth = 1.0;
    for (std::size_t j = k; j < a.octaves(); ++j, growth *= feedback) sum += a.amplitude(j) * growth;
    return sum;
}

template <class Curve, class Numbers>
HWY_INLINE typename Numbers::Number multifractal(const Curve& curve, double feedback, Numbers& a,
                                                 const typename Numbers::Domain& at) {
    auto sum = a.begin_sum();
    auto weight = a.constant(1.0);
    for (std::size_t k = 0; k < a.octaves(); ++k) {
        const double per_weight = feedback > 0.0 ? amplitude_by_weight(feedback, a, k) : a.amplitude_from(k);
        if (!a.sees_weighed(sum, k, at, weight, a.amplitude_from(k), per_weight)) break;
        auto term = a.curved(curve, a.octave(k, at, 1.0 / a.peak()));
        if (feedback > 0.0) {
            if (k > 0) term = a.product_of_positive(weight, term);
            weight = a.curved(SoftClip{feedback}, term);
        }
        a.add(sum, a.scaled(term, a.amplitude(k)));
    }
    return a.total(sum);
}

}  // namespace strata::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
