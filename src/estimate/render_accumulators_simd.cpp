#include "src/estimate/render_accumulators_simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/estimate/render_accumulators_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which sets the target.
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace strata::estimate {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMaxStride = 104;  // of BsplineWeights, at order 100

// BsplineWeights::at_fraction, with up to stride() - m zeros or leftovers behind.
int evaluate(const BsplineWeights& weights, float fraction, double* out) {
    const hn::CappedTag<double, 8> d;
    const BsplineWeights::Cubics cubics = weights.lookup(fraction);
    const std::size_t S = weights.stride();
    const auto s = hn::Set(d, cubics.s);
    const double* c = cubics.c;
    for (std::size_t k = 0; k < static_cast<std::size_t>(weights.order()); k += hn::Lanes(d)) {
        auto w = hn::Add(hn::LoadU(d, c + 2 * S + k), hn::Mul(s, hn::LoadU(d, c + 3 * S + k)));
        w = hn::Add(hn::LoadU(d, c + S + k), hn::Mul(s, w));
        w = hn::Add(hn::LoadU(d, c + k), hn::Mul(s, w));
        hn::Store(hn::Max(w, hn::Zero(d)), d, out + k);
    }
    return cubics.first;
}

// Lanes are the channels of one pixel.
void add_cell_kernel(const BsplineWeights& weights, const CellSamples& samples, const AccumulatorRows& rows, int x0,
                     int x1) {
    HWY_ALIGN double weights_u[kMaxStride];
    HWY_ALIGN double weights_v[kMaxStride];
    const hn::CappedTag<double, kChannels> d;
    const int m = weights.order();
    const int first_row = std::max(rows.window.y0, samples.cell.y - weights.reach());
    const int first_slot = rows.slot(first_row);
    for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
        const int first_x = samples.cell.x + evaluate(weights, samples.fraction_u[i], weights_u);
        const int first_y = samples.cell.y + evaluate(weights, samples.fraction_v[i], weights_v);
        const int left = std::max(0, x0 - first_x);
        const int right = std::min(m, x1 - first_x);
        const int top = std::max(0, rows.window.y0 - first_y);
        const int bottom = std::min(m, rows.window.y1 - first_y);
        if (left >= right || top >= bottom) continue;
        const int top_slot = rows.wrapped(first_slot + (first_y + top - first_row));
        const glm::dvec3 radiance(samples.radiance[i]);
        HWY_ALIGN const double value[kChannels] = {radiance.x, radiance.y, radiance.z, 1.0};
        for (std::size_t c = 0; c < kChannels; c += hn::Lanes(d)) {
            const auto lanes = hn::Load(d, value + c);
            int slot = top_slot;
            for (int y = top; y < bottom; ++y, slot = rows.wrapped(slot + 1)) {
                const auto scaled = hn::Mul(lanes, hn::Set(d, weights_v[y]));
                double* sum = rows.at(first_x + left, slot) + c;
                for (int x = left; x < right; ++x, sum += kChannels) {
                    const auto product = hn::Mul(scaled, hn::Set(d, weights_u[x]));
                    hn::StoreU(hn::Add(hn::LoadU(d, sum), product), d, sum);
                }
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace strata::estimate
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace strata::estimate {

HWY_EXPORT(add_cell_kernel);

void add_cell(const BsplineWeights& weights, const CellSamples& samples, const AccumulatorRows& rows, int x0, int x1) {
    HWY_DYNAMIC_DISPATCH(add_cell_kernel)(weights, samples, rows, x0, x1);
}

}  // namespace strata::estimate
#endif
