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
    alignas(HWY_MAX_BYTES) float first[kLanes] = {};  // the first octave to be subtracted
    double reach = 0.0;
    std::size_t least = 0;  // of `first`
};

// Subtracts the octaves' gradients from block.gradient.
template <bool kPlanar>
HWY_INLINE void subtract_octaves(const TracePlan& plan, GradientBlock& block) {
    const FloatTag d;
    const WidePoint x = {load_wide(block.x[0]), load_wide(block.x[1]), load_wide(block.x[2])};
    FloatVec gx = hn::Load(d, block.gradient[0]), gy = hn::Load(d, block.gradient[1]),
             gz = hn::Load(d, block.gradient[2]);
    const FloatVec first = hn::Load(d, block.first);
    for (std::size_t k = block.least; k < plan.octaves.size(); ++k) {
        const TraceOctave& octave = plan.octaves[k];
        const OctaveSample n = sample_octave<kPlanar>(octave, x, block.reach);
        const FloatVec slope = hn::IfThenElseZero(hn::Le(first, hn::Set(d, static_cast<float>(k))),
                                                  hn::Set(d, static_cast<float>(octave.amplitude * octave.frequency)));
        gx = hn::NegMulAdd(slope, n.dx, gx);
        gy = hn::NegMulAdd(slope, n.dy, gy);
        gz = hn::NegMulAdd(slope, n.dz, gz);
    }
    hn::Store(gx, d, block.gradient[0]);
    hn::Store(gy, d, block.gradient[1]);
    hn::Store(gz, d, block.gradient[2]);
}

HWY_INLINE void finish_block(const Field& field, const TracePlan& plan, GradientBlock& block) {
    if (field.is_planar_noise()) {
        subtract_octaves<true>(plan, block);
    } else {
        subtract_octaves<false>(plan, block);
    }
}

// hits: empty, or what is known of each gradient already.
void Gradients(const Field& field, const TracePlan& plan, std::span<const Hit> hits, std::span<const glm::dvec3> x,
               std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag()), octaves = plan.octaves.size();
    for (std::size_t begin = 0; begin < x.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, x.size() - begin);
        GradientBlock block;
        block.least = octaves;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t first = hits.empty() ? 0 : hits[begin + i].octaves;
            const glm::vec3 known =
                first == 0 ? glm::vec3(field.base_gradient(x[begin + i])) : hits[begin + i].gradient;
            const glm::dvec3 at = noise_shift.empty() ? x[begin + i] : x[begin + i] + noise_shift[begin + i];
            for (int a = 0; a < 3; ++a) {
                block.x[a][i] = at[a];
                block.gradient[a][i] = known[a];
                block.reach = std::max(block.reach, std::abs(at[a]));
            }
            block.first[i] = static_cast<float>(first);
            block.least = std::min(block.least, first);
            counters.noise_evaluations += octaves - first;
        }
        counters.executed_lanes += lanes * (octaves - block.least);
        if (block.least < octaves) finish_block(field, plan, block);
        for (std::size_t i = 0; i < count; ++i) {
            gradient[begin + i] = {block.gradient[0][i], block.gradient[1][i], block.gradient[2][i]};
        }
    }
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(Gradients);

void FastTracer::gradients(std::span<const glm::dvec3> x, std::span<const glm::dvec3> noise_shift,
                           std::span<glm::vec3> gradient, TraceCounters& counters) const {
    HWY_DYNAMIC_DISPATCH(Gradients)(field_, plan_, {}, x, noise_shift, gradient, counters);
}

void FastTracer::gradients(std::span<const Hit> hits, std::span<const glm::dvec3> x,
                           std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient,
                           TraceCounters& counters) const {
    HWY_DYNAMIC_DISPATCH(Gradients)(field_, plan_, hits, x, noise_shift, gradient, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
