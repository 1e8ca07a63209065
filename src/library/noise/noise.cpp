#include "src/noise.h"

#include "noise/bounds.h"
#include "noise/float_error.h"
#include "noise/hash.h"
#include "noise/noise.h"
#include "src/library/noise/spans.h"

namespace strata {

template <std::size_t D>
Noise<D>::Noise(std::uint64_t seed) : key_(noise::lattice_key(seed, 0).axis) {}

template <std::size_t D>
void Noise<D>::values(const NoisePoints<D>& points, std::span<float> value) const {
    check_spans<D>(points.offset, value);
    noise::noise_value({key_}, noise::Points<D>{points.cell, points.offset}, value);
}

template <std::size_t D>
void Noise<D>::gradients(const NoisePoints<D>& points, std::span<float> value, const Gradients<D>& gradient) const {
    check_spans<D>(points.offset, value, gradient.axis);
    noise::noise_gradient({key_}, noise::Points<D>{points.cell, points.offset}, value,
                          noise::GradientSpans<D>{gradient.axis});
}

template <std::size_t D>
void Noise<D>::hessians(const NoisePoints<D>& points, std::span<float> value, const Gradients<D>& gradient,
                        const Hessians<D>& hessian) const {
    check_spans<D>(points.offset, value, gradient.axis, hessian.entry);
    noise::noise_hessian({key_}, noise::Points<D>{points.cell, points.offset}, value,
                         noise::GradientSpans<D>{gradient.axis}, noise::HessianSpans<D>{hessian.entry});
}

template <std::size_t D>
Bounds Noise<D>::bounds() {
    const noise::NoiseBounds& of_noise = noise::kNoiseBounds<D>;
    return {of_noise.value, of_noise.gradient, of_noise.second, of_noise.third};
}

template <std::size_t D>
Rounding Noise<D>::rounding() {
    const noise::FloatErrors& of_noise = noise::kFloatErrors<D>;
    return {of_noise.value, of_noise.gradient_axis, of_noise.hessian_entry};
}

template class Noise<2>;
template class Noise<3>;

}  // namespace strata
