#include "src/estimate/render_accumulators.h"

#include <algorithm>

namespace strata::estimate {

namespace {

constexpr std::size_t kPageDoubles = 512;
constexpr std::size_t kRowOffset = 40;

// Rows a multiple of 4096 bytes apart would compete for the same cache sets and store-buffer addresses.
std::size_t padded_stride(int width) {
    const std::size_t used = static_cast<std::size_t>(width) * kChannels;
    return (used + kPageDoubles - 1) / kPageDoubles * kPageDoubles + kRowOffset;
}

}  // namespace

PixelAccumulators::PixelAccumulators(const film::Rect& window, const BsplineWeights& weights, int rows)
    : weights_(weights),
      sums_(static_cast<std::size_t>(rows) * padded_stride(window.width()), 0.0),
      rows_{window, rows, padded_stride(window.width()), sums_.data()} {}

void PixelAccumulators::finish(int y0, int y1, int x0, int x1, film::Film& film) {
    for (int y = y0; y < y1; ++y) {
        double* sum = rows_.at(x0, rows_.slot(y));
        for (int x = x0; x < x1; ++x, sum += kChannels) {
            film.finish(x, y, glm::vec3(glm::dvec3(sum[0], sum[1], sum[2]) / sum[3]));
            if (!film.weights().empty()) film.set_weight(x, y, sum[3]);
            std::fill_n(sum, kChannels, 0.0);
        }
    }
}

}  // namespace strata::estimate
