#include "src/trace/window_jets.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/trace/window_jets.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "src/trace/octave-inl.h"

HWY_BEFORE_NAMESPACE();
namespace strata::trace::HWY_NAMESPACE {

// Value, gradient x y z, Hessian xx yy zz xy xz yz.
using JetSums = std::array<FloatVec, 10>;

struct JetBlock {
    alignas(HWY_MAX_BYTES) double x[3][kMaxLanes] = {};
    alignas(HWY_MAX_BYTES) float octaves[kMaxLanes] = {};
    double reach = 0.0;
    std::size_t most_octaves = 0;
};

template <bool kNear>
HWY_INLINE JetSums add_jet3(const JetSums& sums, const TraceOctave& octave, const WidePoint& x, FloatVec amplitude) {
    const AxisSample px = locate<kNear>(octave, 0, x.x), py = locate<kNear>(octave, 1, x.y);
    const AxisSample pz = locate<kNear>(octave, 2, x.z);
    const simd_noise::Jet3 n =
        simd_noise::noise3(px.planes, py.planes, pz.planes, px.fraction, py.fraction, pz.fraction);
    const FloatVec wave = hn::Set(FloatTag(), static_cast<float>(octave.frequency));
    const FloatVec slope = hn::Mul(amplitude, wave), bend = hn::Mul(slope, wave);
    return {hn::MulAdd(amplitude, n.value, sums[0]), hn::MulAdd(slope, n.dx, sums[1]), hn::MulAdd(slope, n.dy, sums[2]),
            hn::MulAdd(slope, n.dz, sums[3]),        hn::MulAdd(bend, n.dxx, sums[4]), hn::MulAdd(bend, n.dyy, sums[5]),
            hn::MulAdd(bend, n.dzz, sums[6]),        hn::MulAdd(bend, n.dxy, sums[7]), hn::MulAdd(bend, n.dxz, sums[8]),
            hn::MulAdd(bend, n.dyz, sums[9])};
}

template <bool kNear>
HWY_INLINE JetSums add_jet2(const JetSums& sums, const TraceOctave& octave, const WidePoint& x, FloatVec amplitude) {
    const AxisSample px = locate<kNear>(octave, 0, x.x), pz = locate<kNear>(octave, 1, x.z);
    const simd_noise::Jet2 n = simd_noise::noise2(px.planes, pz.planes, px.fraction, pz.fraction);
    const FloatVec wave = hn::Set(FloatTag(), static_cast<float>(octave.frequency));
    const FloatVec slope = hn::Mul(amplitude, wave), bend = hn::Mul(slope, wave);
    JetSums result = sums;
    result[0] = hn::MulAdd(amplitude, n.value, sums[0]);
    result[1] = hn::MulAdd(slope, n.dx, sums[1]);
    result[3] = hn::MulAdd(slope, n.dy, sums[3]);
    result[4] = hn::MulAdd(bend, n.dxx, sums[4]);
    result[6] = hn::MulAdd(bend, n.dyy, sums[6]);
    result[8] = hn::MulAdd(bend, n.dxy, sums[8]);
    return result;
}

template <bool kPlanar, bool kNear>
HWY_INLINE JetSums add_jet(const JetSums& sums, const TraceOctave& octave, const WidePoint& x, FloatVec amplitude) {
    if constexpr (kPlanar) return add_jet2<kNear>(sums, octave, x, amplitude);
    return add_jet3<kNear>(sums, octave, x, amplitude);
}

template <bool kPlanar>
HWY_INLINE JetSums sum_jets(const TracePlan& plan, const JetBlock& block) {
    const FloatTag d;
    const WidePoint x = {load_wide(block.x[0]), load_wide(block.x[1]), load_wide(block.x[2])};
    const FloatVec octaves = hn::Load(d, block.octaves);
    JetSums sums;
    sums.fill(hn::Zero(d));
    for (std::size_t k = 0; k < block.most_octaves; ++k) {
        const TraceOctave& octave = plan.octaves[k];
        const auto wanted = hn::Gt(octaves, hn::Set(d, static_cast<float>(k)));
        const FloatVec amplitude = hn::IfThenElseZero(wanted, hn::Set(d, octave.amplitude));
        if (HWY_LIKELY(octave.frequency * block.reach + 2.0 < kNearCells)) {
            sums = add_jet<kPlanar, true>(sums, octave, x, amplitude);
        } else {
            sums = add_jet<kPlanar, false>(sums, octave, x, amplitude);
        }
    }
    return sums;
}

HWY_INLINE void store_jets(const JetSums& sums, std::span<Window> windows) {
    alignas(HWY_MAX_BYTES) float out[10][kMaxLanes];
    for (std::size_t i = 0; i < sums.size(); ++i) hn::Store(sums[i], FloatTag(), out[i]);
    for (std::size_t lane = 0; lane < windows.size(); ++lane) {
        Window& window = windows[lane];
        window.value = out[0][lane];
        window.gradient = {out[1][lane], out[2][lane], out[3][lane]};
        for (std::size_t i = 0; i < window.hessian.size(); ++i) window.hessian[i] = out[4 + i][lane];
    }
}

void EvaluateJets(const Field& field, std::span<Window> windows, TraceCounters& counters) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    for (std::size_t begin = 0; begin < windows.size(); begin += lanes) {
        const std::span<Window> part = windows.subspan(begin, std::min(lanes, windows.size() - begin));
        JetBlock block;
        for (std::size_t lane = 0; lane < part.size(); ++lane) {
            const Window& window = part[lane];
            for (int a = 0; a < 3; ++a) {
                block.x[a][lane] = window.centre[a];
                block.reach = std::max(block.reach, std::abs(window.centre[a]));
            }
            block.octaves[lane] = static_cast<float>(window.octaves);
            block.most_octaves = std::max<std::size_t>(block.most_octaves, window.octaves);
            counters.noise_evaluations += window.octaves;
            ++counters.steps;
        }
        counters.executed_lanes += lanes * block.most_octaves;
        store_jets(by_dimensions(field, [&](auto planar) HWY_ATTR { return sum_jets<planar()>(field.plan(), block); }),
                   part);
    }
}

}  // namespace strata::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::trace {

HWY_EXPORT(EvaluateJets);

void WindowJets::evaluate(std::span<Window> windows, TraceCounters& counters) const {
    HWY_DYNAMIC_DISPATCH(EvaluateJets)(field_, windows, counters);
}

}  // namespace strata::trace
#endif  // HWY_ONCE
