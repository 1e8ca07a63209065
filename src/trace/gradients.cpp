#include <algorithm>

#include "src/trace/fast_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/gradients.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/octave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

inline constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(float);

struct GradientBlock {
    alignas(HWY_MAX_BYTES) double x[3][kLanes] = {};  // of the noise
    alignas(HWY_MAX_BYTES) float gradient[3][kLanes] = {};
    double reach = 0.0;
};

// Subtracts the octaves' gradients from block.gradient.
template <bool kPlanar>
HWY_INLINE void subtract_octaves(const TracePlan& plan, GradientBlock& block) {
    const FloatTag d;
    const WidePoint x = {load_wide(block.x[0]), load_wide(block.x[1]), load_wide(block.x[2])};
    FloatVec gx = hn::Load(d, block.gradient[0]), gy = hn::Load(d, block.gradient[1]),
             gz = hn::Load(d, block.gradient[2]);
    for (const TraceOctave& octave : plan.octaves) {
        const OctaveSample n = sample_octave<kPlanar>(octave, x, block.reach);
        const FloatVec slope = hn::Set(d, static_cast<float>(octave.amplitude * octave.frequency));
        gx = hn::NegMulAdd(slope, n.dx, gx);
        gy = hn::NegMulAdd(slope, n.dy, gy);
        gz = hn::NegMulAdd(slope, n.dz, gz);
    }
    hn::Store(gx, d, block.gradient[0]);
    hn::Store(gy, d, block.gradient[1]);
    hn::Store(gz, d, block.gradient[2]);
}

void Gradients(const Field& field, const TracePlan& plan, std::span<const glm::dvec3> x,
               std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    for (std::size_t begin = 0; begin < x.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, x.size() - begin);
        GradientBlock block;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 base = field.base_gradient(x[begin + i]);
            const glm::dvec3 at = noise_shift.empty() ? x[begin + i] : x[begin + i] + noise_shift[begin + i];
            for (int a = 0; a < 3; ++a) {
                block.x[a][i] = at[a];
                block.gradient[a][i] = static_cast<float>(base[a]);
                block.reach = std::max(block.reach, std::abs(at[a]));
            }
        }
        if (field.is_planar_noise()) {
            subtract_octaves<true>(plan, block);
        } else {
            subtract_octaves<false>(plan, block);
        }
        for (std::size_t i = 0; i < count; ++i) {
            gradient[begin + i] = {block.gradient[0][i], block.gradient[1][i], block.gradient[2][i]};
        }
        counters.noise_evaluations += count * plan.octaves.size();
        counters.executed_lanes += lanes * plan.octaves.size();
    }
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(Gradients);

void FastTracer::gradients(std::span<const glm::dvec3> x, std::span<const glm::dvec3> noise_shift,
                           std::span<glm::vec3> gradient, TraceCounters& counters) const {
    HWY_DYNAMIC_DISPATCH(Gradients)(field_, plan_, x, noise_shift, gradient, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
