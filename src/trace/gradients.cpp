#include <algorithm>

#include "src/trace/fast_tracer.h"
#include "src/trace/relief_tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/gradients.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/octave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

inline constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(float);

// Points whose gradients lack octaves, a lane each.
struct GradientBlock {
    alignas(HWY_MAX_BYTES) double x[3][kLanes] = {};  // of the noise
    alignas(HWY_MAX_BYTES) float gradient[3][kLanes] = {};
    alignas(HWY_MAX_BYTES) float first[kLanes] = {};  // the first octave to be subtracted
    double reach = 0.0;
    std::size_t least = 0;  // of `first`
    std::size_t count = 0;
    std::size_t point[kLanes] = {};
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

// Finishes the points gathered in `block` and starts a new one.
HWY_INLINE void finish_block(const Field& field, const TracePlan& plan, GradientBlock& block,
                             std::span<glm::vec3> gradient, TraceCounters& counters) {
    if (block.count == 0) return;
    by_dimensions(field, [&](auto planar) HWY_ATTR { subtract_octaves<planar()>(plan, block); });
    counters.executed_lanes += hn::Lanes(FloatTag()) * (plan.octaves.size() - block.least);
    for (std::size_t i = 0; i < block.count; ++i) {
        gradient[block.point[i]] = {block.gradient[0][i], block.gradient[1][i], block.gradient[2][i]};
    }
    block.count = 0;
    block.reach = 0.0;
    block.least = plan.octaves.size();
}

// The noise is evaluated at x; the gradient of the rest and of the first octaves is `known`.
HWY_INLINE void take_point(GradientBlock& block, std::size_t point, const glm::dvec3& x, const glm::vec3& known,
                           std::size_t first) {
    const std::size_t lane = block.count++;
    for (int a = 0; a < 3; ++a) {
        block.x[a][lane] = x[a];
        block.gradient[a][lane] = known[a];
        block.reach = std::max(block.reach, std::abs(x[a]));
    }
    block.first[lane] = static_cast<float>(first);
    block.least = std::min(block.least, first);
    block.point[lane] = point;
}

// hits: empty, or what is known of each gradient already.
void Gradients(const Field& field, const TracePlan& plan, std::span<const Hit> hits, std::span<const glm::dvec3> x,
               std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag()), octaves = plan.octaves.size();
    GradientBlock block;
    block.least = octaves;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::size_t first = hits.empty() ? 0 : hits[i].octaves;
        if (!hits.empty() && first == octaves) {
            gradient[i] = hits[i].gradient;
            continue;
        }
        const glm::vec3 known = first == 0 ? glm::vec3(field.base_gradient(x[i])) : hits[i].gradient;
        take_point(block, i, noise_shift.empty() ? x[i] : x[i] + noise_shift[i], known, first);
        counters.noise_evaluations += octaves - first;
        if (block.count == lanes) finish_block(field, plan, block, gradient, counters);
    }
    finish_block(field, plan, block, gradient, counters);
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(Gradients);

void FastTracer::gradients(std::span<const glm::dvec3> x, std::span<const glm::dvec3> noise_shift,
                           std::span<glm::vec3> gradient, TraceCounters& counters) const {
    if (field_.relief_plan() != nullptr)
        return relief_gradients(field_, *field_.relief_plan(), x, noise_shift, gradient, counters);
    HWY_DYNAMIC_DISPATCH(Gradients)(field_, field_.plan(), {}, x, noise_shift, gradient, counters);
}

void FastTracer::gradients(std::span<const Hit> hits, std::span<const glm::dvec3> x,
                           std::span<const glm::dvec3> noise_shift, std::span<glm::vec3> gradient,
                           TraceCounters& counters) const {
    if (field_.relief_plan() != nullptr)
        return relief_gradients(field_, *field_.relief_plan(), x, noise_shift, gradient, counters);
    HWY_DYNAMIC_DISPATCH(Gradients)(field_, field_.plan(), hits, x, noise_shift, gradient, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
